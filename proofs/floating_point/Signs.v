(** Signs by the bound E = 12 u P + 2^-1060 (1 + |w|_1): "The bound" of docs/accuracy.md.

    First for any expression of the right shape ([bound_holds]); then for the edge functions, T and D
    of [bounds.py], in all the forms in which it computes them. Numbers may be of any size, infinite,
    or NaN: what is proven is that the tracer's comparison, where it turns out true, is right. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees Rounding Magnitude Finite.
Open Scope R_scope.

(** ** Vectors of expressions, and what [vector.py] and [bounds.py] make of them *)

Definition tvec : Type := expr * expr * expr.
Definition X (a : tvec) := fst (fst a).
Definition Y (a : tvec) := snd (fst a).
Definition Z' (a : tvec) := snd a.
Definition tdot a b := Add (Add (Mul (X a) (X b)) (Mul (Y a) (Y b))) (Mul (Z' a) (Z' b)).
Definition tsub a b : tvec := (Sub (X a) (X b), Sub (Y a) (Y b), Sub (Z' a) (Z' b)).
Definition tabs a : tvec := (Abs (X a), Abs (Y a), Abs (Z' a)).
Definition tmax a b : tvec := (Max (X a) (X b), Max (Y a) (Y b), Max (Z' a) (Z' b)).
Definition tcross a b : tvec :=
  (Sub (Mul (Y a) (Z' b)) (Mul (Z' a) (Y b)), Sub (Mul (Z' a) (X b)) (Mul (X a) (Z' b)),
   Sub (Mul (X a) (Y b)) (Mul (Y a) (X b))).
Definition tsize a b : tvec := (* cross_magnitude *)
  (Add (Mul (Y a) (Z' b)) (Mul (Z' a) (Y b)), Add (Mul (Z' a) (X b)) (Mul (X a) (Z' b)),
   Add (Mul (X a) (Y b)) (Mul (Y a) (X b))).
Definition tbound p w := (* bound; 12 u is 3 2^-51 *)
  Add (Mul (Num 3 (-51)) p) (Mul (Num 1 (-1060)) (Add (Add (Add (Num 1 0) (X w)) (Y w)) (Z' w))).

(** ** The bound, for any expression *)

Definition slack : R := bpow radix2 (-1060).
Lemma slack_pos : 0 < slack. Proof. apply bpow_gt_0. Qed.
Lemma eta_slack : eta = slack / 32768.
Proof.
  unfold eta, slack. replace (-1060)%Z with (-1074 + 14)%Z by lia. rewrite bpow_plus.
  change (bpow radix2 14) with 16384. lra.
Qed.

Lemma float_12u : is_float (3 * bpow radix2 (-51)).
Proof. now apply number_float. Qed.
Lemma float_slack : is_float (1 * bpow radix2 (-1060)).
Proof. now apply number_float. Qed.
Lemma float_one : is_float (1 * bpow radix2 0).
Proof. now apply number_float. Qed.

(** What makes the second part of the bound: a vector of absolute values of leaves, or differences. *)
Definition plain_size (v : renv) (w : expr) : Prop :=
  ring_expr w /\ (depth w <= 1)%nat /\ mag v w = ex v w /\ room v w = ex v w /\ 0 <= ex v w.

Section Bound.
Variable v : renv.
Hypothesis floats : forall name, is_float (r_var v name).

(** e has at most 8 roundings, p is its size, w what its cross product is multiplied by. Then e is
    off by at most three quarters of the bound, computed with all its roundings; and the bound is not
    much less than it should be. *)
Theorem bound_holds_and e p w :
  ring_expr e -> ring_expr p -> (depth e <= 8)%nat -> (depth p <= 8)%nat ->
  mag v p = mag v e -> ex v p = mag v e -> room v p = room v e ->
  plain_size v (X w) -> plain_size v (Y w) -> plain_size v (Z' w) ->
  room v e <= mag v e + eta * (2 * (ex v (X w) + ex v (Y w) + ex v (Z' w)) + 3) ->
  Rabs (fl v e - ex v e) <= 3 / 4 * fl v (tbound p w) /\
  11 * u * mag v e + slack / 2 * (1 + (ex v (X w) + ex v (Y w) + ex v (Z' w))) <= fl v (tbound p w).
Proof.
  intros Re Rp De Dp Mp Ep Op [Rx [Dx [Mx [Ox Px]]]] [Ry [Dy [My [Oy Py]]]] [Rz [Dz [Mz [Oz Pz]]]] Hr.
  set (W := ex v (X w) + ex v (Y w) + ex v (Z' w)) in *.
  assert (HW : 0 <= W) by (unfold W; lra).
  set (m := mag v e) in *. assert (Hm : 0 <= m) by apply mag_pos.
  assert (R8 : Rabs (fl v e - ex v e) <= A 8 * (m + eta * (2 * W + 3)) - m).
  { eapply Rle_trans; [now apply error|]. fold m.
    generalize (A_mono _ _ De) (A_ge_1 (depth e)) (room_ge_mag v e). fold m. intros.
    assert (A (depth e) * room v e <= A 8 * (m + eta * (2 * W + 3))) by (apply Rmult_le_compat; lra).
    lra. }
  assert (RE : ring_expr (tbound p w)).
  { unfold tbound; cbn [ring_expr].
    repeat split; auto using float_12u, float_slack, float_one. }
  assert (DE : (depth (tbound p w) <= 10)%nat) by (unfold tbound; cbn [depth leaf andb]; lia).
  assert (N12 : Rabs (3 * bpow radix2 (-51)) = 12 * u).
  { unfold u. rewrite Rabs_right; [simpl; lra|]. generalize (bpow_ge_0 radix2 (-51)); lra. }
  assert (N1 : Rabs (1 * bpow radix2 0) = 1) by (simpl; rewrite Rmult_1_r; apply Rabs_R1).
  assert (NS : Rabs (1 * bpow radix2 (-1060)) = slack).
  { unfold slack. rewrite Rmult_1_l. apply Rabs_right, Rle_ge, bpow_ge_0. }
  assert (ME : mag v (tbound p w) = 12 * u * m + slack * (1 + W)).
  { unfold tbound. cbn [mag value]. rewrite N12, N1, NS, Mp, Mx, My, Mz. unfold W. ring. }
  assert (OE : room v (tbound p w) = 12 * u * room v e + eta + (slack * (1 + W) + eta)).
  { unfold tbound. cbn [room value]. rewrite N12, N1, NS, Op, Ox, Oy, Oz. unfold W. ring. }
  assert (EE : ex v (tbound p w) = 12 * u * m + slack * (1 + W)).
  { unfold tbound. cbn [value]. rewrite Ep. unfold W, slack, u. simpl (bpow radix2 0).
    replace (bpow radix2 (-51)) with (2 * bpow radix2 (-52)) by (simpl; lra). field. }
  assert (H := error v floats (tbound p w) RE). rewrite ME, OE, EE in H.
  apply Rabs_le_inv in H. destruct H as [H _].
  assert (A10 : A (depth (tbound p w)) <= 1 + 11 * u).
  { eapply Rle_trans; [apply A_mono, DE|]. unfold A. rewrite u_value. simpl. lra. }
  assert (A8 : A 8 <= 1 + (8 + / 64) * u) by (unfold A; rewrite u_value; simpl; lra).
  assert (U := u_pos). assert (Us := u_small). assert (S := slack_pos). rewrite eta_slack in *.
  set (s := slack) in *. set (ad := A (depth (tbound p w))) in *. set (F := fl v (tbound p w)) in *.
  assert (A1 : 1 <= ad) by apply A_ge_1.
  assert (HR : 0 <= room v e) by (generalize (room_ge_mag v e); fold m; lra).
  (* the bound is at least this *)
  assert (L : 12 * u * m + s * (1 + W) - 12 * u * (11 * u * m) - s * (1 + W) / 64 <= F).
  { assert (K1 : ad * (12 * u * room v e + s / 32768 + (s * (1 + W) + s / 32768))
        <= (1 + 11 * u) * (12 * u * (m + s / 32768 * (2 * W + 3)) + s / 32768 + (s * (1 + W) + s / 32768))).
    { apply Rmult_le_compat; try lra; nra. }
    assert (K2 : 0 <= s * (1 + W)) by nra. assert (K3 : 0 <= u * m) by nra.
    assert (K4 : s <= s * (1 + W)) by nra.
    assert (K5 : s * (2 * W + 3) <= 3 * (s * (1 + W))) by nra.
    assert (K6 : u * (s * (2 * W + 3)) <= u * (3 * (s * (1 + W)))) by (apply Rmult_le_compat_l; lra).
    assert (K7 : u * (s * (1 + W)) <= / 1000000 * (s * (1 + W))) by (apply Rmult_le_compat_r; lra).
    assert (K8 : u * s <= s) by nra.
    assert (K9 : u * (u * (s * (2 * W + 3))) <= u * (s * (2 * W + 3))).
    { assert (0 <= u * (s * (2 * W + 3))) by (apply Rmult_le_pos; [lra|]; apply Rmult_le_pos; lra). nra. }
    lra. }
  assert (K2 : 0 <= s * (1 + W)) by nra. assert (K3 : 0 <= u * m) by nra.
  assert (K4 : u * (u * m) <= / 1000000 * (u * m)) by (apply Rmult_le_compat_r; lra).
  assert (K5 : s * (2 * W + 3) <= 3 * (s * (1 + W))) by nra.
  assert (K6 : A 8 * (m + s / 32768 * (2 * W + 3)) <= (1 + (8 + / 64) * u) * (m + s / 32768 * (2 * W + 3))).
  { apply Rmult_le_compat_r; [|exact A8]. assert (0 <= s * (2 * W + 3)) by (apply Rmult_le_pos; lra). lra. }
  assert (K7 : u * (s * (2 * W + 3)) <= s * (2 * W + 3)).
  { assert (0 <= s * (2 * W + 3)) by (apply Rmult_le_pos; lra). nra. }
  split; [lra|]. fold W. lra.
Qed.

Theorem bound_holds e p w :
  ring_expr e -> ring_expr p -> (depth e <= 8)%nat -> (depth p <= 8)%nat ->
  mag v p = mag v e -> ex v p = mag v e -> room v p = room v e ->
  plain_size v (X w) -> plain_size v (Y w) -> plain_size v (Z' w) ->
  room v e <= mag v e + eta * (2 * (ex v (X w) + ex v (Y w) + ex v (Z' w)) + 3) ->
  Rabs (fl v e - ex v e) <= 3 / 4 * fl v (tbound p w).
Proof. intros. now apply bound_holds_and. Qed.
End Bound.

(** ** From real numbers to comparisons in binary64 *)

(** [bounds v E e]: E is not negative, and where it is finite, so is e, and e is off by at most three
    quarters of E. And E is never tiny: neither for float64 nor for e. *)
Definition bounds (v : env) (E e : expr) : Prop :=
  not_negative (eval v E) /\
  (is_finite (eval v E) = true ->
   is_finite (eval v e) = true /\
   Rabs (B2R (eval v e) - ex (real_env v) e) <= 3 / 4 * B2R (eval v E) /\
   slack <= B2R (eval v E) /\ 11 * u * Rabs (B2R (eval v e)) <= B2R (eval v E)).

Lemma real_env_floats v name : is_float (r_var (real_env v) name).
Proof. apply B2R_is_float. Qed.

(** P of the code may be larger than that of this one ray and triangle, which the theorem is about. *)
Lemma rnd_ge_float x y : is_float x -> x <= y -> x <= rnd y.
Proof. intros F H. rewrite <- (rnd_id x F). now apply rnd_le. Qed.

(** E is at least 2^-1060, and nearly 12 u P. *)
Lemma bound_least v p w : not_negative (eval v p) ->
  not_negative (eval v (X w)) -> not_negative (eval v (Y w)) -> not_negative (eval v (Z' w)) ->
  is_finite (eval v (tbound p w)) = true ->
  is_finite (eval v p) = true /\ slack <= B2R (eval v (tbound p w)) /\
  11 * u * B2R (eval v p) <= B2R (eval v (tbound p w)).
Proof.
  intros Pp Px Py Pz F. revert F. unfold tbound. cbn [eval]. intros F.
  destruct (plus_finite _ _ F) as [F1 F2]. destruct (mult_finite _ _ F1) as [Fn Fp].
  destruct (mult_finite _ _ F2) as [Fs F3]. destruct (plus_finite _ _ F3) as [F4 Fz].
  destruct (plus_finite _ _ F4) as [F5 Fy]. destruct (plus_finite _ _ F5) as [Fo Fx].
  assert (B12 : B2R (num 3 (-51)) = 12 * u) by (rewrite num_value by easy; unfold u; simpl; lra).
  assert (BS : B2R (num 1 (-1060)) = slack) by (rewrite num_value by easy; apply Rmult_1_l).
  assert (B1 : B2R (num 1 0) = 1) by (rewrite num_value by easy; simpl; lra).
  rewrite (plus_value _ _ F), (mult_value _ _ F1), (mult_value _ _ F2), (plus_value _ _ F3),
    (plus_value _ _ F4), (plus_value _ _ F5), B12, BS, B1.
  assert (V := not_negative_value _ Pp Fp). assert (Vx := not_negative_value _ Px Fx).
  assert (Vy := not_negative_value _ Py Fy). assert (Vz := not_negative_value _ Pz Fz).
  set (P := B2R (eval v p)) in *. set (x := B2R (eval v (X w))) in *.
  set (y := B2R (eval v (Y w))) in *. set (z := B2R (eval v (Z' w))) in *.
  assert (One : is_float 1) by (rewrite <- B1; apply B2R_is_float).
  assert (K1 : 1 <= rnd (1 + x)) by (apply rnd_ge_float; auto; lra).
  assert (K2 : 1 <= rnd (rnd (1 + x) + y)) by (apply rnd_ge_float; auto; lra).
  assert (K3 : 1 <= rnd (rnd (rnd (1 + x) + y) + z)) by (apply rnd_ge_float; auto; lra).
  assert (S := slack_pos). assert (U := u_pos). assert (Us := u_small).
  assert (FS : is_float slack) by (rewrite <- BS; apply B2R_is_float).
  set (k := rnd (rnd (rnd (1 + x) + y) + z)) in *.
  assert (K4 : slack <= rnd (slack * k)) by (apply rnd_ge_float; auto; nra).
  assert (K5 : 0 <= rnd (12 * u * P)) by (apply rnd_pos; nra).
  assert (K6 := rnd_err (12 * u * P)).
  assert (K7 := rnd_err_sum (rnd (12 * u * P)) (rnd (slack * k)) (rnd_float _) (rnd_float _)).
  split; [exact Fp|]. split; [apply rnd_ge_float; auto; lra|].
  assert (N := eta_slack). rewrite (Rabs_right (12 * u * P)) in K6 by nra.
  apply Rabs_le_inv in K6. rewrite (Rabs_right (rnd (12 * u * P) + rnd (slack * k))) in K7 by lra.
  apply Rabs_le_inv in K7. assert (0 <= u * P) by nra.
  assert (u * (u * P) <= / 1000000 * (u * P)) by (apply Rmult_le_compat_r; lra).
  set (E := rnd (rnd (12 * u * P) + rnd (slack * k))) in *.
  assert (u * rnd (12 * u * P) <= / 1000000 * rnd (12 * u * P)) by (apply Rmult_le_compat_r; lra).
  assert (u * rnd (slack * k) <= / 1000000 * rnd (slack * k)) by (apply Rmult_le_compat_r; lra).
  lra.
Qed.

Lemma bounds_by v p w e one :
  dominates v p e -> not_negative (eval v (X w)) -> not_negative (eval v (Y w)) ->
  not_negative (eval v (Z' w)) -> dominates v (tbound p w) one -> arithmetic e = true ->
  arithmetic one = true ->
  Rabs (fl (real_env v) e - ex (real_env v) e) <= 3 / 4 * fl (real_env v) one ->
  bounds v (tbound p w) e.
Proof.
  intros [Pp De] Px Py Pz [P Do] Ae Ao H. split; [exact P|]. intros F.
  destruct (bound_least v p w Pp Px Py Pz F) as [F2 [L1 L2]].
  destruct (De F2) as [Fe Le]. destruct (Do F) as [Fo L]. split; [exact Fe|].
  split; [|split; [exact L1|]].
  - rewrite (finite_value v _ e (real_agrees v) Ae Fe). rewrite (finite_value v _ one (real_agrees v) Ao Fo) in L.
    generalize (Rle_abs (fl (real_env v) one)). lra.
  - eapply Rle_trans; [|exact L2]. apply Rmult_le_compat_l; [generalize u_pos; lra | exact Le].
Qed.

(** What is a bound stays one if something larger takes its place. *)
Lemma bounds_max v E F e : not_negative (eval v E) -> not_negative (eval v F) ->
  bounds v E e \/ bounds v F e -> bounds v (Max E F) e.
Proof.
  intros PE PF H. split; [simpl; now apply not_negative_max|]. cbn [eval]. intros Fin.
  destruct H as [H|H]; destruct H as [P B].
  - destruct (above_max (eval v E) (eval v F) (eval v E)) as [_ K]; auto using above_same.
    destruct (K Fin) as [FE L]. destruct (B FE) as [Fe [Le [L1 L2]]]. split; [exact Fe|].
    generalize (Rle_abs (B2R (eval v E))). repeat split; lra.
  - destruct (above_max (eval v E) (eval v F) (eval v F)) as [_ K]; auto using above_same.
    destruct (K Fin) as [FE L]. destruct (B FE) as [Fe [Le [L1 L2]]]. split; [exact Fe|].
    generalize (Rle_abs (B2R (eval v F))). repeat split; lra.
Qed.

Lemma not_below_infinity (x : float) : Bcompare (B754_infinity false) x <> Some Datatypes.Lt.
Proof. destruct x as [[]|[]| |[] ? ? ?]; simpl; discriminate. Qed.

Lemma decided_finite (E x : float) : not_negative E ->
  Bcompare E x = Some Datatypes.Lt \/ Bcompare x (Bopp E) = Some Datatypes.Lt -> is_finite E = true.
Proof.
  intros [N|N] H.
  - destruct E as [[]|[]| |[] ? ? ?]; try discriminate. destruct H as [H|H]; [discriminate|].
    destruct x as [[]|[]| |[] ? ? ?]; discriminate.
  - destruct E as [s|s| |s m e h]; auto; simpl in N; try subst s.
    + destruct H as [H|H]; [now apply not_below_infinity in H|].
      destruct x as [[]|[]| |[] ? ? ?]; discriminate.
    + destruct H as [H|H]; [discriminate|]. destruct x as [[]|[]| |[] ? ? ?]; discriminate.
Qed.

Theorem sure_positive v E e : bounds v E e -> holds v (Less E e) = true -> 0 < ex (real_env v) e.
Proof.
  intros [P B] H. simpl in H. destruct (Bcompare (eval v E) (eval v e)) as [[]|] eqn:C; try discriminate.
  assert (F : is_finite (eval v E) = true) by (eapply decided_finite; eauto).
  destruct (B F) as [Fe [L _]]. rewrite (Bcompare_correct prec emax _ _ F Fe) in C.
  injection C as C. apply Rcompare_Lt_inv in C.
  generalize (not_negative_value _ P F). apply Rabs_le_inv in L. lra.
Qed.

Theorem sure_negative v E e : bounds v E e -> holds v (Less e (Neg E)) = true ->
  ex (real_env v) e < 0.
Proof.
  intros [P B] H. simpl in H. destruct (Bcompare (eval v e) (Bopp (eval v E))) as [[]|] eqn:C; try discriminate.
  assert (F : is_finite (eval v E) = true) by (eapply decided_finite; eauto).
  destruct (B F) as [Fe [L _]].
  rewrite (Bcompare_correct prec emax) in C by (auto; now rewrite is_finite_Bopp).
  rewrite B2R_Bopp in C. injection C as C. apply Rcompare_Lt_inv in C.
  generalize (not_negative_value _ P F). apply Rabs_le_inv in L. lra.
Qed.
