(** Triangles with small boxes: the bounds are numbers, the same for all.

    See "Small triangles" in docs/speed.md; the code is small_boxes.py. A corner is a film position
    (x, y), counted from the first pixel of the box: a vector whose w is 1. Film.v says that it is off
    by at most DELTA where it is `certain`. Nothing here is large, so nothing overflows; the nearness
    and its bound are finite as the corners' are, and half of |T| is more than 2^-20. *)
Require Import ZArith Reals Psatz String.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding EdgeFunctions.
Open Scope R_scope.

(** ** What is computed *)

(** The constants _E, _ET, _PER_T, _OWN: the floats that Python makes of their formulas. *)
Definition DELTA : R := bpow radix2 (-25).
Definition E : R := IZR 2345391125639987 * bpow radix2 (-69).
Definition ET : R := IZR 7249389938113249 * bpow radix2 (-70).
Definition PER_T : R := IZR 1130585054183171 * bpow radix2 (-63).
Definition OWN : R := IZR 6756061982938979 * bpow radix2 (-48).

Definition of_1 (a b : vec) : R := rnd (rnd (vx a * vy b) - rnd (vy a * vx b)).
Definition volume (a b c : vec) : R := rnd (rnd (of_1 b c + of_1 c a) + of_1 a b).
Definition small_edge (s : R) (a b : vec) (up right : R) : R :=
  rnd (rnd (rnd (of_1 a b * s) + rnd (rnd (rnd (vx b - vx a) * s) * up))
       + rnd (rnd (rnd (vy a - vy b) * s) * right)).

(** A box of one pixel has the constant alone. It is the same. *)
Lemma one_pixel s a b : small_edge s a b 0 0 = rnd (of_1 a b * s).
Proof.
  unfold small_edge. rewrite !Rmult_0_r, rnd_0, !Rplus_0_r.
  now rewrite !(rnd_id (rnd (of_1 a b * s))) by apply rnd_float.
Qed.

(** The nearness, from those of the corners, and its bound. *)
Definition scale (amount : R) : R := rnd (1 / Rmax amount (2 * ET)).
Definition nearness (amount na nb nc e_ca e_ab : R) : R :=
  let b := rnd (rnd (nb - na) * scale amount) in let c := rnd (rnd (nc - na) * scale amount) in
  rnd (rnd (rnd (e_ca * b) + rnd (e_ab * c)) + na).
Definition nearness_error (amount na nb nc own : R) : R :=
  rnd (rnd (rnd (Rmax (Rabs (rnd (nb - na))) (Rabs (rnd (nc - na))) * scale amount) * PER_T)
    + rnd (OWN * own)).

Lemma numbers : 3.9732471e-6 <= E <= 3.9732472e-6 /\ 6.1404721e-6 <= ET <= 6.1404722e-6 /\
  12.1 * (E + ET) <= PER_T /\ 24 <= OWN <= 25.
Proof. unfold E, ET, PER_T, OWN. simpl. repeat split; lra. Qed.

(** ** Edge functions and T *)

Section Trees.
Local Open Scope string_scope.
Let env (a b c : vec) (up right : R) : renv := REnv (fun n =>
  if String.eqb n "ax" then vx a else if String.eqb n "ay" then vy a else
  if String.eqb n "bx" then vx b else if String.eqb n "by" then vy b else
  if String.eqb n "cx" then vx c else if String.eqb n "cy" then vy c else
  if String.eqb n "up" then up else right) (fun _ => true).
Let cx (p q r s : string) := Sub (Mul (Var p) (Var q)) (Mul (Var r) (Var s)).
Let tree_e := Add (Add (cx "ax" "by" "ay" "bx") (Mul (Sub (Var "bx") (Var "ax")) (Var "up")))
                  (Mul (Sub (Var "ay") (Var "by")) (Var "right")).
Let tree_T := Add (Add (cx "bx" "cy" "by" "cx") (cx "cx" "ay" "cy" "ax")) (cx "ax" "by" "ay" "bx").

Lemma A_4 : A 4 <= 1 + 5 * u.
Proof. unfold A. rewrite u_value. simpl. lra. Qed.

Definition in_plane (k : R) (v : vec) : Prop := Rabs (vx v) <= k /\ Rabs (vy v) <= k.
Definition floats (v : vec) : Prop := is_float (vx v) /\ is_float (vy v).
Definition flat (v : vec) : vec := V (vx v) (vy v) 1.

Lemma env_float a b c up right : floats a -> floats b -> floats c -> is_float up ->
  is_float right -> forall n, is_float (r_var (env a b c up right) n).
Proof.
  intros [A1 A2] [B1 B2] [C1 C2] U R n. simpl.
  repeat match goal with |- is_float (if ?x then _ else _) => destruct x; [assumption|] end. assumption.
Qed.

Lemma small_rounding a b up right : floats a -> floats b -> is_float up -> is_float right ->
  in_plane 17 a -> in_plane 17 b -> Rabs up <= 16 -> Rabs right <= 16 ->
  Rabs (small_edge 1 a b up right - det (flat a) (flat b) (pixel_ray up right)) <= 5 * u * 1666 + 5 * eta.
Proof.
  intros Fa Fb Fu Fr [Ax Ay] [Bx By_] U R.
  assert (X := error (env a b a up right) (env_float a b a up right Fa Fb Fa Fu Fr) tree_e).
  assert (G : ring_expr tree_e) by (simpl; repeat split). specialize (X G). clear G.
  replace (fl (env a b a up right) tree_e) with (small_edge 1 a b up right) in X.
  2: { unfold small_edge. rewrite !Rmult_1_r. rewrite (rnd_id (of_1 a b)) by apply rnd_float.
       rewrite (rnd_id (rnd (vx b - vx a))), (rnd_id (rnd (vy a - vy b))) by apply rnd_float. reflexivity. }
  replace (ex (env a b a up right) tree_e) with (det (flat a) (flat b) (pixel_ray up right)) in X
    by (unfold det, dot, cross, flat; simpl; ring).
  eapply Rle_trans; [exact X|]. clear X. change (Rounding.depth tree_e) with 4%nat.
  assert (P := u_pos). assert (N := eta_pos). assert (Q := u_small). assert (K := A_4).
  assert (K1 := A_ge_1 4).
  set (mg := Rabs (vx a) * Rabs (vy b) + Rabs (vy a) * Rabs (vx b) + Rabs (vx b - vx a) * Rabs up
             + Rabs (vy a - vy b) * Rabs right).
  replace (mag (env a b a up right) tree_e) with mg by (unfold mg; simpl; ring).
  replace (room (env a b a up right) tree_e) with (mg + 4 * eta) by (unfold mg; simpl; ring).
  assert (D : forall x y, Rabs x <= 17 -> Rabs y <= 17 -> Rabs (x - y) <= 34).
  { intros x y X Y. apply Rabs_le_inv in X, Y. apply Rabs_le. lra. }
  assert (M0 : 0 <= mg) by (unfold mg; repeat apply Rplus_le_le_0_compat; apply Rmult_le_pos; apply Rabs_pos).
  assert (mg <= 1666).
  { generalize (product_le _ _ _ _ Ax By_) (product_le _ _ _ _ Ay Bx) (product_le _ _ _ _ (D _ _ Bx Ax) U)
      (product_le _ _ _ _ (D _ _ Ay By_) R). unfold mg. lra. }
  assert ((A 4 - 1) * mg <= 5 * u * 1666) by (apply Rmult_le_compat; lra).
  assert (A 4 * eta <= 5/4 * eta) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Lemma volume_rounding a b c : floats a -> floats b -> floats c ->
  in_plane 17 a -> in_plane 17 b -> in_plane 17 c ->
  Rabs (volume a b c - det (flat a) (flat b) (flat c)) <= 5 * u * 1734 + 8 * eta.
Proof.
  intros Fa Fb Fc [Ax Ay] [Bx By_] [Cx Cy].
  assert (Z0 : is_float 0) by apply generic_format_0.
  assert (X := error (env a b c 0 0) (env_float a b c 0 0 Fa Fb Fc Z0 Z0) tree_T).
  assert (G : ring_expr tree_T) by (simpl; repeat split). specialize (X G). clear G.
  change (fl (env a b c 0 0) tree_T) with (volume a b c) in X.
  replace (ex (env a b c 0 0) tree_T) with (det (flat a) (flat b) (flat c)) in X
    by (unfold det, dot, cross, flat; simpl; ring).
  eapply Rle_trans; [exact X|]. clear X. change (Rounding.depth tree_T) with 4%nat.
  assert (P := u_pos). assert (N := eta_pos). assert (Q := u_small). assert (K := A_4).
  assert (K1 := A_ge_1 4).
  set (mg := Rabs (vx b) * Rabs (vy c) + Rabs (vy b) * Rabs (vx c) + (Rabs (vx c) * Rabs (vy a) +
             Rabs (vy c) * Rabs (vx a)) + (Rabs (vx a) * Rabs (vy b) + Rabs (vy a) * Rabs (vx b))).
  replace (mag (env a b c 0 0) tree_T) with mg by (unfold mg; simpl; ring).
  replace (room (env a b c 0 0) tree_T) with (mg + 6 * eta) by (unfold mg; simpl; ring).
  assert (M0 : 0 <= mg) by (unfold mg; repeat apply Rplus_le_le_0_compat; apply Rmult_le_pos; apply Rabs_pos).
  assert (mg <= 1734).
  { generalize (product_le _ _ _ _ Ax By_) (product_le _ _ _ _ Ay Bx) (product_le _ _ _ _ Bx Cy)
      (product_le _ _ _ _ By_ Cx) (product_le _ _ _ _ Cx Ay) (product_le _ _ _ _ Cy Ax). unfold mg. lra. }
  assert ((A 4 - 1) * mg <= 5 * u * 1734) by (apply Rmult_le_compat; lra).
  assert (A 4 * eta <= 5/4 * eta) by (apply Rmult_le_compat_r; lra). lra.
Qed.
End Trees.

Lemma small_edge_sign s a b up right : s = 1 \/ s = -1 ->
  small_edge s a b up right = s * small_edge 1 a b up right.
Proof.
  unfold small_edge. rewrite !Rmult_1_r. intros [-> | ->]; [rewrite !Rmult_1_r; ring|].
  assert (M : forall x, x * -1 = - x) by (intros; ring).
  rewrite !M, !rnd_opp, <- !Ropp_mult_distr_l, !rnd_opp, <- Ropp_plus_distr, rnd_opp,
    <- Ropp_plus_distr, rnd_opp. ring.
Qed.

(** Corners as computed, relative to the first pixel, and exactly. A corner lies in the box or less
    than a pixel beside it, so it is at most 16.5 away. That it is off by at most DELTA has to include
    the rounding of x - x0. *)
Definition near_by (v v' : vec) : Prop := Rabs (vx v - vx v') <= DELTA /\ Rabs (vy v - vy v') <= DELTA.
Definition corner (v v' : vec) : Prop := floats v /\ in_plane (33/2) v /\ near_by v v'.

(** The rounding is far smaller: less than 17 u. *)
Lemma counted x x' x0 : is_float x -> is_float x0 -> Rabs (x - x') <= DELTA - 34 * u ->
  Rabs (rnd (x - x0)) <= 33/2 -> Rabs (rnd (x - x0) - (x' - x0)) <= DELTA.
Proof.
  intros F F0 D B. assert (E := rnd_err_sum x (- x0) F (is_float_opp _ F0)).
  assert (P := u_pos). assert (Q := u_small). change (x + - x0) with (x - x0) in E.
  assert (Rabs (x - x0) <= 17).
  { assert (T := Rabs_triang_inv (x - x0) (rnd (x - x0))). rewrite (Rabs_minus_sym _ (rnd (x - x0))) in T.
    assert (u * Rabs (x - x0) <= / 1000 * Rabs (x - x0)) by (apply Rmult_le_compat_r; [apply Rabs_pos | lra]).
      lra. }
  replace (rnd (x - x0) - (x' - x0)) with ((rnd (x - x0) - (x - x0)) + (x - x')) by ring.
  eapply Rle_trans; [apply Rabs_triang|].
  assert (u * Rabs (x - x0) <= u * 17) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Lemma in_17 v v' : corner v v' -> in_plane 17 v /\ in_plane 17 v'.
Proof.
  intros [_ [[X Y] [DX DY]]]. assert (DELTA <= / 4) by (unfold DELTA; simpl; lra).
  apply Rabs_le_inv in X, Y, DX, DY. repeat split; apply Rabs_le; lra.
Qed.

Theorem small_edge_bound a b a' b' up right : corner a a' -> corner b b' ->
  is_float up -> is_float right -> Rabs up <= 16 -> Rabs right <= 16 ->
  Rabs (small_edge 1 a b up right - det (flat a') (flat b') (pixel_ray up right)) <= E.
Proof.
  intros Ca Cb Fu Fr U R. destruct (in_17 _ _ Ca) as [Ia Ia'], (in_17 _ _ Cb) as [Ib Ib'].
  assert (X := small_rounding a b up right (proj1 Ca) (proj1 Cb) Fu Fr Ia Ib U R).
  destruct Ca as [_ [_ [Ax Ay]]], Cb as [_ [_ [Bx By_]]], Ia as [Lx Ly], Ib' as [Mx My].
  set (y := det (flat a) (flat b) (pixel_ray up right)) in *.
  assert (p1 := product_off _ _ _ _ _ _ _ _ Ax By_ Lx My).
  assert (p2 := product_off _ _ _ _ _ _ _ _ Ay Bx Ly Mx).
  assert (D : forall p p' q q', Rabs (p - p') <= DELTA -> Rabs (q - q') <= DELTA -> Rabs (p - q - (p' - q'))
    <= 2 * DELTA).
  { intros p p' q q' H I. apply Rabs_le_inv in H, I. apply Rabs_le. lra. }
  assert (p3 := product_le _ _ _ _ (D _ _ _ _ Bx Ax) U).
  assert (p4 := product_le _ _ _ _ (D _ _ _ _ Ay By_) R).
  rewrite <- Rabs_mult in p3, p4. apply Rabs_le_inv in X, p1, p2, p3, p4.
  assert (y - det (flat a') (flat b') (pixel_ray up right) = vx a * vy b - vx a' * vy b' - (vy a * vx b
    - vy a' * vx b')
    + (vx b - vx a - (vx b' - vx a')) * up + (vy a - vy b - (vy a' - vy b')) * right)
    by (unfold y, det, dot, cross, flat, pixel_ray; simpl; ring).
  assert (eta <= u * u).
  { unfold eta. rewrite u_bpow, <- bpow_plus. simpl Z.add.
    assert (bpow radix2 (-1074) <= bpow radix2 (-106)) by (apply bpow_le; lia).
    generalize (bpow_gt_0 radix2 (-1074)). lra. }
  assert (Q := u_small). assert (P := u_pos). assert (u * u <= u * 1) by (apply Rmult_le_compat_l; lra).
  assert (N := numbers). unfold DELTA in *. simpl bpow in *. apply Rabs_le. lra.
Qed.

Theorem small_volume_bound a b c a' b' c' : corner a a' -> corner b b' -> corner c c' ->
  Rabs (volume a b c - det (flat a') (flat b') (flat c')) <= ET.
Proof.
  intros Ca Cb Cc. destruct (in_17 _ _ Ca) as [Ia Ia'], (in_17 _ _ Cb) as [Ib Ib'], (in_17 _ _ Cc)
    as [Ic Ic'].
  assert (X := volume_rounding a b c (proj1 Ca) (proj1 Cb) (proj1 Cc) Ia Ib Ic).
  destruct Ca as [_ [_ [Ax Ay]]], Cb as [_ [_ [Bx By_]]], Cc as [_ [_ [Cx Cy]]],
    Ia as [Lx Ly], Ib as [Mx My], Ic as [Nx Ny], Ia' as [Lx' Ly'], Ib' as [Mx' My'], Ic' as [Nx' Ny'].
  assert (p1 := product_off _ _ _ _ _ _ _ _ Ax By_ Lx My').
  assert (p2 := product_off _ _ _ _ _ _ _ _ Ay Bx Ly Mx').
  assert (p3 := product_off _ _ _ _ _ _ _ _ Bx Cy Mx Ny').
  assert (p4 := product_off _ _ _ _ _ _ _ _ By_ Cx My Nx').
  assert (p5 := product_off _ _ _ _ _ _ _ _ Cx Ay Nx Ly').
  assert (p6 := product_off _ _ _ _ _ _ _ _ Cy Ax Ny Lx').
  apply Rabs_le_inv in X, p1, p2, p3, p4, p5, p6.
  assert (eta <= u * u).
  { unfold eta. rewrite u_bpow, <- bpow_plus. simpl Z.add.
    assert (bpow radix2 (-1074) <= bpow radix2 (-106)) by (apply bpow_le; lia).
    generalize (bpow_gt_0 radix2 (-1074)). lra. }
  assert (Q := u_small). assert (P := u_pos). assert (u * u <= u * 1) by (apply Rmult_le_compat_l; lra).
  assert (N := numbers). unfold DELTA in *. simpl bpow in *. apply Rabs_le.
  unfold det, dot, cross, flat in *. simpl in *. lra.
Qed.

(** ** What that proves of a pixel *)

Section Pixel.
Variables (a b c a' b' c' : vec) (up right : R).
Hypothesis Ca : corner a a'. Hypothesis Cb : corner b b'. Hypothesis Cc : corner c c'.
Hypothesis f_up : is_float up. Hypothesis f_right : is_float right.
Hypothesis in_up : Rabs up <= 16. Hypothesis in_right : Rabs right <= 16.
Let d := pixel_ray up right.
Let T := det (flat a') (flat b') (flat c').
Let amount := Rabs (volume a b c).
Let s := sign_of (volume a b c).
Let e_bc := det (flat b') (flat c') d.
Let e_ca := det (flat c') (flat a') d.
Let e_ab := det (flat a') (flat b') d.
Hypothesis not_edge_on : amount > 2 * ET. (* else the triangle goes the long way *)

Lemma s_cases : s = 1 \/ s = -1. Proof. apply sign_cases. Qed.
Lemma s_T : Rabs (amount - s * T) <= ET /\ s * T > ET.
Proof.
  assert (H := small_volume_bound a b c a' b' c' Ca Cb Cc). fold T in H. apply Rabs_le_inv in H.
  assert (K := not_edge_on).
  assert (X : (s = -1 /\ amount = - volume a b c) \/ (s = 1 /\ amount = volume a b c)).
  { unfold s, amount, sign_of. destruct (Rlt_bool_spec (volume a b c) 0) as [L|L];
      [left; now rewrite Rabs_left | right; now rewrite Rabs_pos_eq]. }
  destruct X as [[-> X]|[-> X]]; rewrite X in *; (split; [apply Rabs_le; lra | lra]).
Qed.
Lemma small_off v w v' w' : corner v v' -> corner w w' ->
  Rabs (small_edge s v w up right - s * det (flat v') (flat w') d) <= E.
Proof.
  intros Cv Cw. assert (H := small_edge_bound v w v' w' up right Cv Cw f_up f_right in_up in_right).
  fold d in H.
  rewrite small_edge_sign by apply s_cases. apply Rabs_le_inv in H. apply Rabs_le.
  destruct s_cases as [-> | ->]; lra.
Qed.

Let least := Rmin (Rmin (small_edge s b c up right) (small_edge s c a up right)) (small_edge s a b up right).

(** Surely inside: all have the sign of T, exactly, which is not 0. *)
Theorem small_inside : least > E ->
  T <> 0 /\ T * e_bc > 0 /\ T * e_ca > 0 /\ T * e_ab > 0.
Proof.
  intros L. destruct s_T as [_ P]. assert (N := numbers).
  assert (O1 := small_off _ _ _ _ Cb Cc). assert (O2 := small_off _ _ _ _ Cc Ca).
  assert (O3 := small_off _ _ _ _ Ca Cb).
  fold e_bc in O1. fold e_ca in O2. fold e_ab in O3. apply Rabs_le_inv in O1, O2, O3. unfold least in L.
  assert (M1 := Rmin_l (small_edge s b c up right) (small_edge s c a up right)).
  assert (M2 := Rmin_r (small_edge s b c up right) (small_edge s c a up right)).
  assert (M3 := Rmin_l (Rmin (small_edge s b c up right) (small_edge s c a up right)) (small_edge s a b up
    right)).
  assert (M4 := Rmin_r (Rmin (small_edge s b c up right) (small_edge s c a up right)) (small_edge s a b up
    right)).
  assert (K : forall x, s * x > 0 -> T * x > 0) by (intros x H; destruct s_cases as [Z|Z]; rewrite Z in *;
    nra).
  split; [|repeat split; apply K; lra].
  intros Z. rewrite Z in P. lra.
Qed.

(** Dropped: then not all have it, so the ray does not meet the triangle. *)
Theorem small_outside : least < - E -> ~ (0 <= T * e_bc /\ 0 <= T * e_ca /\ 0 <= T * e_ab).
Proof.
  intros L [H1 [H2 H3]]. destruct s_T as [_ P]. assert (N := numbers).
  assert (O1 := small_off _ _ _ _ Cb Cc). assert (O2 := small_off _ _ _ _ Cc Ca).
  assert (O3 := small_off _ _ _ _ Ca Cb).
  fold e_bc in O1. fold e_ca in O2. fold e_ab in O3. apply Rabs_le_inv in O1, O2, O3.
  assert (K : forall x, 0 <= T * x -> 0 <= s * x) by (intros x H; destruct s_cases as [Z|Z]; rewrite Z in *;
    nra).
  apply K in H1, H2, H3. revert L. unfold least. apply Rmin_case; [apply Rmin_case|]; lra.
Qed.
End Pixel.
