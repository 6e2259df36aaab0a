(** The dual axes as [dual_axes] in [camera.py] computes them: near the exact ones, times a factor s
    that all nine numbers share, as all were divided by the one determinant.

    Of the determinant's own error, which may be hundreds of u where the axes are nearly in a plane, a
    perspective camera has to know little: a factor that all vertices share moves nothing on the film. *)
Require Import ZArith Reals Psatz String List.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Camera Place.
Import ListNotations.
Open Scope R_scope.

(** [np.cross]: a product less another. *)
Definition minor (a b c d : R) := rnd (rnd (a * b) - rnd (c * d)).
Definition fcross (u v : vec) :=
  V (minor (vy u) (vz v) (vz u) (vy v)) (minor (vz u) (vx v) (vx u) (vz v)) (minor (vx u) (vy v) (vy u) (vx v)).
Definition fdiv (c : vec) (d : R) := V (rnd (vx c / d)) (rnd (vy c / d)) (rnd (vz c / d)).

Lemma A_2 : A 2 <= 1 + 2001 / 1000 * u. Proof. unfold A. rewrite u_value. simpl. lra. Qed.
Lemma A_5 : A 5 <= 1 + 5001 / 1000 * u. Proof. unfold A. rewrite u_value. simpl. lra. Qed.

Lemma minor_near a b c d : is_float a -> is_float b -> is_float c -> is_float d ->
  near (minor a b c d) (a * b - c * d) (2001 / 1000 * u * (Rabs a * Rabs b + Rabs c * Rabs d) + 3 * eta).
Proof.
  intros Fa Fb Fc Fd. unfold near.
  set (env := given [("a", a); ("b", b); ("c", c); ("d", d)]%string).
  assert (F : forall name, is_float (r_var env name)).
  { apply pick_float. simpl. repeat constructor; assumption. }
  generalize (error env F (Sub (Mul (Var "a") (Var "b")) (Mul (Var "c") (Var "d")))%string ltac:(simpl; tauto)).
  change (Rounding.depth _) with 2%nat. simpl.
  intros H. eapply Rle_trans; [exact H|]. clear H.
  set (x := Rabs a * Rabs b). set (y := Rabs c * Rabs d).
  assert (0 <= x /\ 0 <= y) by (split; apply Rmult_le_pos; apply Rabs_pos).
  replace (x + eta + (y + eta)) with (x + y + 2 * eta) by ring.
  assert (E := eta_pos). assert (P := u_pos). assert (T := u_tiny).
  generalize (A_small 2 (x + y) (2 * eta) (2001 / 1000) A_2 ltac:(lra) ltac:(lra) ltac:(lra)). lra.
Qed.

(** The products that a cross product is made of. *)
Definition terms (u v : vec) :=
  Rabs (vy u) * Rabs (vz v) + Rabs (vz u) * Rabs (vy v) +
  (Rabs (vz u) * Rabs (vx v) + Rabs (vx u) * Rabs (vz v)) +
  (Rabs (vx u) * Rabs (vy v) + Rabs (vy u) * Rabs (vx v)).
Lemma terms_le u v : terms u v <= dot u u + dot v v.
Proof.
  unfold terms, dot. destruct u as [a b c], v as [d e f]; simpl.
  assert (S : forall x, x * x = Rabs x * Rabs x) by (intros; rewrite <- Rabs_mult, Rabs_pos_eq; [ring | nra]).
  rewrite (S a), (S b), (S c), (S d), (S e), (S f).
  generalize (Rabs a) (Rabs b) (Rabs c) (Rabs d) (Rabs e) (Rabs f). intros.
  generalize (Rle_0_sqr (r0 - r4)) (Rle_0_sqr (r1 - r3)) (Rle_0_sqr (r1 - r2)) (Rle_0_sqr (r - r4))
    (Rle_0_sqr (r - r3)) (Rle_0_sqr (r0 - r2)). unfold Rsqr. lra.
Qed.
Lemma L1_cross u v : L1 (cross u v) <= terms u v.
Proof.
  unfold L1, cross, terms; simpl. rewrite <- !Rabs_mult.
  generalize (tri (vy u * vz v) (vz u * vy v) _ _ (Rle_refl _) (Rle_refl _))
    (tri (vz u * vx v) (vx u * vz v) _ _ (Rle_refl _) (Rle_refl _))
    (tri (vx u * vy v) (vy u * vx v) _ _ (Rle_refl _) (Rle_refl _)). lra.
Qed.
Lemma fcross_near p q : floats p -> floats q ->
  L1 (vsub (fcross p q) (cross p q)) <= 2001 / 1000 * u * terms p q + 9 * eta.
Proof.
  intros [P0 [P1 P2]] [Q0 [Q1 Q2]]. unfold L1, vsub, fcross, cross, terms; simpl.
  generalize (minor_near _ _ _ _ P1 Q2 P2 Q1) (minor_near _ _ _ _ P2 Q0 P0 Q2) (minor_near _ _ _ _ P0 Q1 P1 Q0).
  unfold near. lra.
Qed.

(** A determinant is not more than the product of its rows' sizes. *)
Lemma det_L1 a b c : Rabs (det a b c) <= L1 a * L1 b * L1 c.
Proof.
  destruct a as [a0 a1 a2], b as [b0 b1 b2], c as [c0 c1 c2]. unfold det, dot, cross, L1; simpl.
  assert (G : forall x y z w : R, Rabs (x * y - z * w) <= Rabs x * Rabs y + Rabs z * Rabs w)
    by (intros; apply tri; apply prod; apply Rle_refl).
  eapply Rle_trans; [apply tri'; [apply tri'|]; (apply prod; [apply G | apply Rle_refl])|]. clear G.
  generalize (Rabs_pos a0) (Rabs_pos a1) (Rabs_pos a2) (Rabs_pos b0) (Rabs_pos b1) (Rabs_pos b2)
    (Rabs_pos c0) (Rabs_pos c1) (Rabs_pos c2).
  generalize (Rabs a0) (Rabs a1) (Rabs a2) (Rabs b0) (Rabs b1) (Rabs b2) (Rabs c0) (Rabs c1) (Rabs c2).
  intros x0 x1 x2 y0 y1 y2 z0 z1 z2 X0 X1 X2 Y0 Y1 Y2 Z0 Z1 Z2.
  assert (N : forall x y z, 0 <= x -> 0 <= y -> 0 <= z -> 0 <= x * y * z)
    by (intros; repeat apply Rmult_le_pos; assumption).
  generalize (N x0 y0 z0 X0 Y0 Z0) (N x0 y0 z1 X0 Y0 Z1) (N x0 y0 z2 X0 Y0 Z2) (N x0 y1 z0 X0 Y1 Z0)
    (N x0 y1 z1 X0 Y1 Z1) (N x0 y1 z2 X0 Y1 Z2) (N x0 y2 z0 X0 Y2 Z0) (N x0 y2 z1 X0 Y2 Z1)
    (N x0 y2 z2 X0 Y2 Z2) (N x1 y0 z0 X1 Y0 Z0) (N x1 y0 z1 X1 Y0 Z1) (N x1 y0 z2 X1 Y0 Z2)
    (N x1 y1 z0 X1 Y1 Z0) (N x1 y1 z1 X1 Y1 Z1) (N x1 y1 z2 X1 Y1 Z2) (N x1 y2 z0 X1 Y2 Z0)
    (N x1 y2 z1 X1 Y2 Z1) (N x1 y2 z2 X1 Y2 Z2) (N x2 y0 z0 X2 Y0 Z0) (N x2 y0 z1 X2 Y0 Z1)
    (N x2 y0 z2 X2 Y0 Z2) (N x2 y1 z0 X2 Y1 Z0) (N x2 y1 z1 X2 Y1 Z1) (N x2 y1 z2 X2 Y1 Z2)
    (N x2 y2 z0 X2 Y2 Z0) (N x2 y2 z1 X2 Y2 Z1) (N x2 y2 z2 X2 Y2 Z2).
  intros; lra.
Qed.
Lemma means a b c : 0 <= a -> 0 <= b -> 0 <= c -> 27 * (a * b * c) <= (a + b + c) * (a + b + c) * (a + b + c).
Proof.
  intros. assert (0 <= a * ((b - c) * (b - c))) by (apply Rmult_le_pos; [lra | apply Rle_0_sqr]).
  assert (0 <= b * ((c - a) * (c - a))) by (apply Rmult_le_pos; [lra | apply Rle_0_sqr]).
  assert (0 <= c * ((a - b) * (a - b))) by (apply Rmult_le_pos; [lra | apply Rle_0_sqr]).
  assert (0 <= (a + b + c) * ((a - b) * (a - b))) by (apply Rmult_le_pos; [lra | apply Rle_0_sqr]).
  assert (0 <= (a + b + c) * ((b - c) * (b - c))) by (apply Rmult_le_pos; [lra | apply Rle_0_sqr]).
  assert (0 <= (a + b + c) * ((c - a) * (c - a))) by (apply Rmult_le_pos; [lra | apply Rle_0_sqr]).
  lra.
Qed.

Section Dual.
Variables right up forward : vec.
Hypothesis axes_float : floats right /\ floats up /\ floats forward.
(** [has_sound_axes], with room for its own roundings: lengths below 2, |det| not below 1/8. *)
Hypothesis lengths : dot right right <= 401 / 100 /\ dot up up <= 401 / 100 /\ dot forward forward <= 401 / 100.
Notation vol := (volume right up forward).
Hypothesis not_flat : 1249 / 10000 <= Rabs vol.
Variable m : R.
Hypothesis axes_within : within right m /\ within up m /\ within forward m.
Hypothesis m_most : m <= 201 / 100.

(** As computed: the cross products, their determinant [(axes[0] * dual[0]).sum()], the quotients. *)
Definition cr := fcross up forward.
Definition cu := fcross forward right.
Definition cf := fcross right up.
Definition fvolume := fdot right cr.
Definition dr := fdiv cr fvolume.
Definition du := fdiv cu fvolume.
Definition df := fdiv cf fvolume.

Definition permanent :=
  Rabs (vx right) * (Rabs (vy up) * Rabs (vz forward) + Rabs (vz up) * Rabs (vy forward)) +
  Rabs (vy right) * (Rabs (vz up) * Rabs (vx forward) + Rabs (vx up) * Rabs (vz forward)) +
  Rabs (vz right) * (Rabs (vx up) * Rabs (vy forward) + Rabs (vy up) * Rabs (vx forward)).

Lemma m_pos : 0 <= m.
Proof. destruct axes_within as [[H _] _]. eapply Rle_trans; [apply Rabs_pos | exact H]. Qed.

Lemma permanent_le : permanent <= m * (802 / 100).
Proof.
  destruct axes_within as [[H0 [H1 H2]] _]. destruct lengths as [_ [Lu Lf]].
  assert (T := terms_le up forward). assert (M := m_pos).
  apply Rle_trans with (m * terms up forward); [|apply Rmult_le_compat_l; lra].
  unfold permanent, terms.
  assert (Q : forall a b c d e, Rabs a <= m -> Rabs a * (Rabs b * Rabs c + Rabs d * Rabs e) <= m * (Rabs b * Rabs c + Rabs d * Rabs e)).
  { intros. apply Rmult_le_compat_r; [|assumption]. apply Rplus_le_le_0_compat; apply Rmult_le_pos; apply Rabs_pos. }
  generalize (Q _ (vy up) (vz forward) (vz up) (vy forward) H0) (Q _ (vz up) (vx forward) (vx up) (vz forward) H1)
    (Q _ (vx up) (vy forward) (vy up) (vx forward) H2). lra.
Qed.

Lemma fvolume_near : near fvolume vol (5001 / 1000 * u * permanent + 30 * eta).
Proof.
  destruct axes_float as [[r0 [r1 r2]] [[p0 [p1 p2]] [f0 [f1 f2]]]]. unfold near.
  set (env := given [("r0", vx right); ("r1", vy right); ("r2", vz right); ("p0", vx up); ("p1", vy up);
    ("p2", vz up); ("f0", vx forward); ("f1", vy forward); ("f2", vz forward)]%string).
  assert (F : forall name, is_float (r_var env name)).
  { apply pick_float. simpl. repeat constructor; assumption. }
  set (t := fun r a b c d => Mul (Var r) (Sub (Mul (Var a) (Var b)) (Mul (Var c) (Var d)))).
  generalize (error env F (Add (Add (t "r0" "p1" "f2" "p2" "f1") (t "r1" "p2" "f0" "p0" "f2")) (t "r2" "p0" "f1" "p1" "f0"))%string
    ltac:(simpl; tauto)).
  change (Rounding.depth _) with 5%nat. simpl.
  intros H.
  replace (fvolume - vol) with (fvolume - (vx right * (vy up * vz forward - vz up * vy forward) +
    vy right * (vz up * vx forward - vx up * vz forward) + vz right * (vx up * vy forward - vy up * vx forward)))
    by (unfold volume, det, dot, cross; simpl; ring).
  eapply Rle_trans; [exact H|]. clear H.
  destruct axes_within as [[H0 [H1 H2]] _]. assert (E := eta_pos). assert (P := u_pos). assert (T := u_tiny).
  assert (PP : 0 <= permanent).
  { unfold permanent. repeat apply Rplus_le_le_0_compat; (apply Rmult_le_pos; [apply Rabs_pos|]);
      apply Rplus_le_le_0_compat; apply Rmult_le_pos; apply Rabs_pos. }
  match goal with |- A 5 * ?room - ?mag <= _ =>
    replace mag with permanent by (unfold permanent; ring);
    replace room with (permanent + (2 * (Rabs (vx right) + Rabs (vy right) + Rabs (vz right)) + 3) * eta)
      by (unfold permanent; ring) end.
  assert (G : (2 * (Rabs (vx right) + Rabs (vy right) + Rabs (vz right)) + 3) * eta <= 18 * eta) by (apply Rmult_le_compat_r; lra).
  assert (G0 : 0 <= (2 * (Rabs (vx right) + Rabs (vy right) + Rabs (vz right)) + 3) * eta).
  { apply Rmult_le_pos; [|lra]. generalize (Rabs_pos (vx right)) (Rabs_pos (vy right)) (Rabs_pos (vz right)). lra. }
  generalize (A_small 5 permanent _ (5001 / 1000) A_5 ltac:(lra) PP G0). lra.
Qed.

(** The spread as computed: a sum of nine numbers, in whichever order. *)
Definition nine := L1 dr + L1 du + L1 df.
Variable S : R.
Hypothesis S_sum : near S nine (nine / 10000).
Hypothesis m_some : / 4 <= m.

Definition common := vol / fvolume. (* the factor s *)

Lemma volume_off : Rabs (fvolume - vol) <= 402 / 10 * (u * m).
Proof.
  assert (H := fvolume_near). assert (P := u_pos). assert (E := eta_u6). assert (Q := permanent_le).
  assert (u * permanent <= u * (m * (802 / 100))) by (apply Rmult_le_compat_l; lra).
  assert (u * / 4 <= u * m) by (apply Rmult_le_compat_l; lra). unfold near in H. lra.
Qed.
Lemma volume_range : 12489 / 100000 <= Rabs fvolume /\ 999 / 1000 * Rabs fvolume <= Rabs vol /\
  Rabs vol <= 1001 / 1000 * Rabs fvolume /\ Rabs vol <= 17.
Proof.
  assert (H := volume_off). assert (P := u_pos). assert (T := u_tiny). assert (M := m_most).
  assert (u * m <= u * (201 / 100)) by (apply Rmult_le_compat_l; lra).
  assert (V := not_flat). assert (Rabs vol <= 17).
  { unfold volume, det. destruct axes_within as [[F0 [F1 F2]] _]. 
    assert (W := dot_L1 (cross right up) forward m (proj2 (proj2 axes_within))).
    assert (B := L1_cross right up). assert (B' := terms_le right up). destruct lengths as [R0 [R1 _]].
    assert (L1 (cross right up) * m <= 802 / 100 * (201 / 100)) by (apply Rmult_le_compat; try lra; apply L1_pos). lra. }
  generalize (Rabs_triang_inv vol fvolume) (Rabs_triang_inv fvolume vol). rewrite (Rabs_minus_sym vol). lra.
Qed.
Lemma fvolume_not_0 : fvolume <> 0.
Proof. intros E. destruct volume_range as [H _]. rewrite E, Rabs_R0 in H. lra. Qed.
Lemma vol_not_0 : vol <> 0.
Proof. intros E. generalize not_flat. rewrite E, Rabs_R0. lra. Qed.
Notation k := (/ Rabs fvolume).
Lemma k_pos : 0 < k. Proof. apply Rinv_0_lt_compat. generalize (proj1 volume_range). lra. Qed.

Lemma row_off p q : floats p -> floats q -> dot p p <= 401 / 100 -> dot q q <= 401 / 100 ->
  L1 (vsub (fdiv (fcross p q) fvolume) (vscale (/ fvolume) (cross p q))) <= 243 / 10 * (u * k) /\
  L1 (cross p q) <= 802 / 100.
Proof.
  intros Fp Fq Lp Lq. assert (H := fcross_near p q Fp Fq). assert (B := terms_le p q). assert (C := L1_cross p q).
  assert (P := u_pos). assert (T := u_tiny). assert (E := eta_u6). assert (Pe := eta_pos).
  split; [|lra]. assert (K := k_pos).
  assert (u * terms p q <= u * (802 / 100)) by (apply Rmult_le_compat_l; lra).
  set (e := L1 (vsub (fcross p q) (cross p q))) in *.
  assert (Lc : L1 (fcross p q) <= 803 / 100).
  { assert (L1 (fcross p q) <= L1 (cross p q) + e); [|lra].
    unfold e. generalize (fcross p q) (cross p q). intros [a b c] [x y z]. unfold L1, vsub; simpl.
    generalize (Rabs_triang_inv a x) (Rabs_triang_inv b y) (Rabs_triang_inv c z). lra. }
  assert (G : forall a x, Rabs (rnd (a / fvolume) - / fvolume * x) <= (u * Rabs a + Rabs (a - x)) * k + eta).
  { intros a x. replace (rnd (a / fvolume) - / fvolume * x) with
      ((rnd (a / fvolume) - a / fvolume) + (a - x) * / fvolume) by (unfold Rdiv; ring).
    eapply Rle_trans; [apply Rabs_triang|]. generalize (rnd_err (a / fvolume)).
    unfold Rdiv. rewrite !Rabs_mult, !Rabs_inv. intros R. lra. }
  assert (L : L1 (vsub (fdiv (fcross p q) fvolume) (vscale (/ fvolume) (cross p q))) <= (u * L1 (fcross p q) + e) * k + 3 * eta).
  { unfold e. generalize (fcross p q) (cross p q). intros [a b c] [x y z]. unfold L1, vsub, fdiv, vscale; simpl.
    generalize (G a x) (G b y) (G c z). lra. }
  assert (u * L1 (fcross p q) <= u * (803 / 100)) by (apply Rmult_le_compat_l; lra).
  assert ((u * L1 (fcross p q) + e) * k <= (2409 / 100 * u) * k) by (apply Rmult_le_compat_r; lra).
  assert (u * / 18 <= u * k).
  { apply Rmult_le_compat_l; [lra|]. apply Rinv_le; [|]; destruct volume_range as [V0 [V1 [V2 V3]]]; lra. }
  lra.
Qed.

Lemma scaled_dual p q : vscale common (vscale (/ vol) (cross p q)) = vscale (/ fvolume) (cross p q).
Proof. unfold common. assert (V := vol_not_0). assert (F := fvolume_not_0). apply vec_eq; simpl; field; now split. Qed.

Lemma rows : let off d e := L1 (vsub d (vscale common e)) in
  off dr (dual_right right up forward) <= 243 / 10 * (u * k) /\
  off du (dual_up right up forward) <= 243 / 10 * (u * k) /\
  off df (dual_depth right up forward) <= 243 / 10 * (u * k).
Proof.
  intros off. unfold off, dual_right, dual_up, dual_depth. rewrite !scaled_dual.
  destruct axes_float as [Fr [Fu Ff]], lengths as [Lr [Lu Lf]].
  repeat split; apply row_off; assumption.
Qed.

Lemma L1_near d c e : L1 (vsub d (vscale (/ fvolume) c)) <= e -> Rabs (L1 d - L1 c * k) <= e.
Proof.
  intros H. assert (S1 : L1 (vscale (/ fvolume) c) = L1 c * k).
  { unfold L1, vscale; simpl. rewrite !Rabs_mult, Rabs_inv. ring. }
  rewrite <- S1. revert H. generalize (vscale (/ fvolume) c). intros w. unfold L1, vsub; simpl.
  destruct d as [a b c'], w as [x y z]; simpl. intros H. apply Rabs_le.
  generalize (Rabs_triang_inv a x) (Rabs_triang_inv b y) (Rabs_triang_inv c' z)
    (Rabs_triang_inv x a) (Rabs_triang_inv y b) (Rabs_triang_inv z c').
  rewrite (Rabs_minus_sym x), (Rabs_minus_sym y), (Rabs_minus_sym z). lra.
Qed.

(** How large the dual axes are, at least and at most. *)
Definition cofactors := L1 (cross up forward) + L1 (cross forward right) + L1 (cross right up).
Lemma cofactors_some : 749 / 1000 <= cofactors /\ 149 / 100 * Rabs vol <= cofactors /\ cofactors <= 2406 / 100.
Proof.
  destruct axes_float as [Fr [Fu Ff]], lengths as [Lr [Lu Lf]]. destruct axes_within as [Wr [Wu Wf]].
  assert (A := L1_pos (cross up forward)). assert (B := L1_pos (cross forward right)). assert (C := L1_pos (cross right up)).
  assert (D : det (cross up forward) (cross forward right) (cross right up) = vol * vol).
  { unfold volume, det, dot, cross; simpl; ring. }
  assert (E := det_L1 (cross up forward) (cross forward right) (cross right up)).
  rewrite D, Rabs_mult in E. assert (G := means _ _ _ A B C). fold cofactors in G.
  assert (N := not_flat). assert (C0 : 0 <= cofactors) by (unfold cofactors; lra).
  assert (Q : 1249 / 10000 * (1249 / 10000) <= Rabs vol * Rabs vol) by (apply Rmult_le_compat; lra).
  assert (M := m_pos). assert (H := dot_L1 _ _ _ Wr : Rabs (dot (cross up forward) right) <= _).
  split; [|split].
  - destruct (Rle_or_lt (749 / 1000) cofactors) as [|L]; [assumption|exfalso].
    assert (cofactors * cofactors <= 749 / 1000 * (749 / 1000)) by (apply Rmult_le_compat; lra).
    assert (cofactors * cofactors * cofactors <= 749 / 1000 * (749 / 1000) * (749 / 1000)).
    { apply Rmult_le_compat; try lra. now apply Rmult_le_pos. }
    lra.
  - assert (V1 : Rabs vol <= L1 (cross up forward) * m).
    { replace vol with (dot (cross up forward) right) by (unfold volume, det, dot, cross; simpl; ring). now apply dot_L1. }
    assert (V2 : Rabs vol <= L1 (cross forward right) * m).
    { replace vol with (dot (cross forward right) up) by (unfold volume, det, dot, cross; simpl; ring). now apply dot_L1. }
    assert (V3 : Rabs vol <= L1 (cross right up) * m).
    { replace vol with (dot (cross right up) forward) by (unfold volume, det, dot, cross; simpl; ring). now apply dot_L1. }
    assert (cofactors * m <= cofactors * (201 / 100)) by (apply Rmult_le_compat_l; lra).
    unfold cofactors in *. lra.
  - unfold cofactors. generalize (proj2 (row_off _ _ Fu Ff Lu Lf)) (proj2 (row_off _ _ Ff Fr Lf Lr)) (proj2 (row_off _ _ Fr Fu Lr Lu)). lra.
Qed.
Lemma nine_near : Rabs (nine - cofactors * k) <= 73 * (u * k).
Proof.
  destruct rows as [R0 [R1 R2]]. unfold dual_right, dual_up, dual_depth in *. rewrite scaled_dual in *.
  apply L1_near in R0, R1, R2. apply Rabs_le_inv in R0, R1, R2. apply Rabs_le.
  unfold nine, cofactors. assert (0 < u * k) by (apply Rmult_lt_0_compat; [apply u_pos | apply k_pos]). lra.
Qed.
Lemma k_S : k <= 134 / 100 * S /\ 1 <= S /\ S <= 200.
Proof.
  assert (H := Rabs_le_inv _ _ nine_near). assert (G := Rabs_le_inv _ _ S_sum).
  destruct cofactors_some as [C0 [C1 C2]]. assert (K := k_pos). assert (P := u_pos). assert (T := u_tiny).
  destruct volume_range as [V0 [V1 [V2 V3]]].
  assert (uk : u * k <= / 1000000 * k) by (apply Rmult_le_compat_r; lra).
  assert (A : 749 / 1000 * k <= cofactors * k) by (apply Rmult_le_compat_r; lra).
  assert (B : 149 / 100 * (999 / 1000) <= cofactors * k).
  { apply Rmult_le_reg_r with (Rabs fvolume); [lra|].
    replace (cofactors * k * Rabs fvolume) with cofactors by (field; lra). lra. }
  assert (D : cofactors * k <= 2406 / 100 * k) by (apply Rmult_le_compat_r; lra).
  assert (K8 : k <= 100000 / 12489).
  { replace (100000 / 12489) with (/ (12489 / 100000)) by field. apply Rinv_le; lra. }
  repeat split; lra.
Qed.

(** What [Film.v] asks for. *)
Theorem dual_floats : floats dr /\ floats du /\ floats df.
Proof. repeat split; apply rnd_float. Qed.
Theorem spread_enough : L1 dr <= 1001 / 1000 * S /\ L1 du <= 1001 / 1000 * S /\ L1 df <= 1001 / 1000 * S.
Proof.
  assert (G := Rabs_le_inv _ _ S_sum). unfold nine in *.
  generalize (L1_pos dr) (L1_pos du) (L1_pos df). lra.
Qed.
Theorem dual_near_common : let off d e := L1 (vsub d (vscale common e)) in
  off dr (dual_right right up forward) <= 33 * (u * S) /\
  off du (dual_up right up forward) <= 33 * (u * S) /\
  off df (dual_depth right up forward) <= 33 * (u * S).
Proof.
  intros off. destruct rows as [R0 [R1 R2]]. destruct k_S as [K _].
  assert (u * k <= u * (134 / 100 * S)) by (apply Rmult_le_compat_l; [apply Rlt_le, u_pos | exact K]).
  assert (0 < u * k) by (apply Rmult_lt_0_compat; [apply u_pos | apply k_pos]).
  unfold off. repeat split; lra.
Qed.
Lemma common_off : Rabs (common - 1) <= Rabs (fvolume - vol) * k.
Proof.
  unfold common. assert (F := fvolume_not_0).
  replace (vol / fvolume - 1) with (- ((fvolume - vol) * / fvolume)) by (field; exact F).
  rewrite Rabs_Ropp, Rabs_mult, Rabs_inv. apply Rle_refl.
Qed.
Theorem common_small : Rabs (common - 1) <= / 100 /\ Rabs (common - 1) <= 54 * (u * (S * m)).
Proof.
  assert (H := common_off). assert (V := volume_off). assert (K := k_pos). destruct k_S as [KS [S1 S2]].
  assert (P := u_pos). assert (T := u_tiny). assert (M := m_most). assert (M0 := m_some).
  assert (A : Rabs (fvolume - vol) * k <= 402 / 10 * (u * m) * (134 / 100 * S)) by (apply Rmult_le_compat; try lra; apply Rabs_pos).
  assert (0 < S * m) by (apply Rmult_lt_0_compat; lra).
  assert (S * m <= 200 * (201 / 100)) by (apply Rmult_le_compat; lra).
  assert (B : Rabs (common - 1) <= 54 * (u * (S * m))).
  { assert (0 < u * (S * m)) by (apply Rmult_lt_0_compat; lra).
    replace (402 / 10 * (u * m) * (134 / 100 * S)) with (402 / 10 * (134 / 100) * (u * (S * m))) in A by field. lra. }
  split; [|exact B]. assert (u * (S * m) <= / 1000000000 * (S * m)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(** An orthographic camera has no use for a factor; the axes must be further from a plane. *)
Hypothesis well_apart : permanent <= 119 / 10 * Rabs vol.
Theorem dual_near_exactly : let off d e := L1 (vsub d (vscale 1 e)) in
  off dr (dual_right right up forward) <= 100 * (u * S) /\
  off du (dual_up right up forward) <= 100 * (u * S) /\
  off df (dual_depth right up forward) <= 100 * (u * S).
Proof.
  intros off. destruct dual_near_common as [R0 [R1 R2]]. destruct spread_enough as [B0 [B1 B2]].
  assert (H := common_off). destruct common_small as [C _]. apply Rabs_le_inv in C.
  assert (N := fvolume_near). destruct volume_range as [V0 [V1 [V2 V3]]]. assert (K := k_pos).
  destruct k_S as [KS [S1 S2]]. assert (P := u_pos). assert (T := u_tiny). assert (E := eta_u6).
  assert (Q : Rabs (common - 1) <= 60 * u).
  { eapply Rle_trans; [exact H|]. apply Rmult_le_reg_r with (Rabs fvolume); [lra|].
    rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. unfold near in N.
    assert (u * permanent <= u * (119 / 10 * Rabs vol)) by (apply Rmult_le_compat_l; lra).
    assert (u * Rabs vol <= u * (1001 / 1000 * Rabs fvolume)) by (apply Rmult_le_compat_l; lra).
    assert (u * (12489 / 100000) <= u * Rabs fvolume) by (apply Rmult_le_compat_l; lra). lra. }
  assert (G : forall d e, L1 (vsub d (vscale common e)) <= 33 * (u * S) -> L1 d <= 1001 / 1000 * S -> off d e <= 100 * (u * S)).
  { intros d e A B. assert (U : 0 < u * S) by (apply Rmult_lt_0_compat; lra).
    assert (uS : u * S <= / 1000000 * S) by (apply Rmult_le_compat_r; lra).
    assert (L : L1 (vscale common e) <= L1 d + L1 (vsub d (vscale common e))).
    { unfold L1, vsub; simpl. destruct d as [a b c]; simpl.
      generalize (Rabs_triang_inv (common * vx e) a) (Rabs_triang_inv (common * vy e) b) (Rabs_triang_inv (common * vz e) c).
      rewrite (Rabs_minus_sym _ a), (Rabs_minus_sym _ b), (Rabs_minus_sym _ c). lra. }
    assert (L' : L1 (vscale common e) = common * L1 e).
    { unfold L1, vscale; simpl. rewrite !Rabs_mult, (Rabs_pos_eq common) by lra. ring. }
    assert (Le : L1 e <= 102 / 100 * S).
    { assert (99 / 100 * L1 e <= common * L1 e) by (apply Rmult_le_compat_r; [apply L1_pos | lra]). lra. }
    assert (F : off d e <= L1 (vsub d (vscale common e)) + Rabs (common - 1) * L1 e).
    { unfold off, L1, vsub, vscale; simpl. destruct d as [a b c], e as [x y z]; simpl. rewrite !Rmult_plus_distr_l, <- !Rabs_mult.
      generalize (Rabs_triang (a - common * x) ((common - 1) * x)) (Rabs_triang (b - common * y) ((common - 1) * y))
        (Rabs_triang (c - common * z) ((common - 1) * z)).
      replace (a - common * x + (common - 1) * x) with (a - 1 * x) by ring.
      replace (b - common * y + (common - 1) * y) with (b - 1 * y) by ring.
      replace (c - common * z + (common - 1) * z) with (c - 1 * z) by ring. lra. }
    assert (Rabs (common - 1) * L1 e <= 60 * u * (102 / 100 * S)) by (apply Rmult_le_compat; try lra; [apply Rabs_pos | apply L1_pos]).
    lra. }
  repeat split; apply G; assumption.
Qed.
End Dual.
