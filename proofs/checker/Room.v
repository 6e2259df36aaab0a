(** `forms` of verify.py: that `error` has room for all roundings.

    A form is (point + times r) . vector, of which the code computes constant + slope . middle, for the
    middle of the box around a square's rays r; half of the box moves it by |slope| . half at most. Here:
    for each r in the box, the exact value is off from what is computed by less than `reach` as computed,
    in rounded real numbers ([form_near]). Of the 512 u of `error` some 450 u are used; of 2^-1040,
    some 2^-1067, and 2^-1045 is left for what becomes of T and D. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Signs.
From Reftrace Require Import RoomParts.
Open Scope R_scope.
Open Scope string_scope.

Section Form.
Variable v : renv.
Hypothesis floats : forall name, is_float (r_var v name).
Notation exact_most := (exact_most v).

Variable f : form.
Notation p := (point f).
Notation n := (vector f).
Variable M : R.
Notation P := (exact_most p).
Notation k := (IZR (times f)).
Notation L := (r_var v "largest").
Notation h c := (fl v (c half)).
Notation m c := (fl v (c middle)).
Notation s c := (fl v (c (slope f))).
Notation K := (P + Rabs k * L).
Hypothesis few : times f = 0%Z \/ times f = 1%Z \/ times f = (-1)%Z.
Hypothesis points : atoms v p.
Hypothesis vectors : components v M n.
Hypothesis size_low : (1 - 4 * u) * M - eta <= fl v (size f).
Hypothesis M_pos : 0 <= M.
Hypothesis size_pos : 0 <= fl v (size f).
Hypothesis middle_small : Rabs (m X) <= L /\ Rabs (m Y) <= L /\ Rabs (m Z') <= L.
Hypothesis half_small : 0 <= h X <= 4 * L /\ 0 <= h Y <= 4 * L /\ 0 <= h Z' <= 4 * L.

Lemma L_pos : 0 <= L. Proof. generalize (Rabs_pos (m X)). lra. Qed.
Lemma k_one : Rabs k = 0 \/ Rabs k = 1.
Proof. destruct few as [-> | [-> | ->]]; [left; apply Rabs_R0 | right; apply Rabs_R1 | right]. unfold Rabs.
destruct Rcase_abs; lra. Qed.
Lemma K_pos : 0 <= K.
Proof. generalize (most_pos v p) L_pos (Rabs_pos k). intros.
assert (0 <= Rabs k * L) by (apply Rmult_le_pos; lra). lra. Qed.


Lemma tiny : 0 < bpow radix2 (-1040) /\ bpow radix2 (-1043) = bpow radix2 (-1040) / 8 /\
  eta = bpow radix2 (-1040) / 34359738368.
Proof.
  split; [apply bpow_gt_0|]. unfold eta. replace (-1074)%Z with (-1040 + -34)%Z by lia.
  replace (-1043)%Z with (-1040 + -3)%Z by lia. rewrite !bpow_plus. generalize (bpow radix2 (-1040)).
  intros w. change (bpow radix2 (-34)) with (/ 17179869184). change (bpow radix2 (-3)) with (/ 8). split; lra.
Qed.
(** What has d roundings, and r of underflow. *)
Lemma from_room e c r : ring_expr e -> A (depth e) <= 1 + c * u -> 0 <= c <= 16 ->
  room v e <= mag v e + r -> 0 <= r -> Rabs (fl v e - ex v e) <= c * u * mag v e + 2 * r.
Proof.
  intros R D C H Hr. generalize (error v floats e R). assert (U := u_small). assert (W := u_pos).
  assert (Am := A_ge_1 (depth e)). assert (Hm := mag_pos v e).
  assert (A (depth e) * room v e <= A (depth e) * (mag v e + r)) by (apply Rmult_le_compat_l; lra).
  assert (A (depth e) * mag v e <= (1 + c * u) * mag v e) by (apply Rmult_le_compat_r; lra).
  assert (A (depth e) * r <= 2 * r) by (apply Rmult_le_compat_r; nra). lra.
Qed.
Lemma A_5 d : (d <= 5)%nat -> A d <= 1 + (5 + / 2) * u.
Proof.
  intros H. eapply Rle_trans; [apply (A_mono _ _ H)|]. unfold A. rewrite u_value. simpl. lra.
Qed.
Lemma A_9 d : (d <= 9)%nat -> A d <= 1 + 10 * u.
Proof.
  intros H. eapply Rle_trans; [apply (A_mono _ _ H)|]. unfold A. rewrite u_value. simpl. lra.
Qed.

(** A scalar product of the point and the vector. *)
Lemma mag_product x y A B : 0 <= x <= A -> 0 <= y <= B -> 0 <= x * y <= A * B.
Proof. intros. split; [apply Rmult_le_pos; lra | apply Rmult_le_compat; lra]. Qed.
Notation fixed := (tdot p n).
Lemma fixed_room : ring_expr fixed /\ (depth fixed <= 8)%nat /\ mag v fixed <= 6 * (M * P) /\
  room v fixed <= mag v fixed + eta * (6 * P + 3).
Proof.
  destruct points as ((Rx & Dx & Mx & Ox) & (Ry & Dy & My & Oy) & (Rz & Dz & Mz & Oz)).
  destruct vectors as ((Rx' & Dx' & Mx' & Ox') & (Ry' & Dy' & My' & Oy') & (Rz' & Dz' & Mz' & Oz')).
  destruct (most_is (ex v (X p)) (ex v (Y p)) (ex v (Z' p))) as (A1 & A2 & A3).
  fold (exact_most p) in A1, A2, A3.
  assert (Px := Rabs_pos (ex v (X p))). assert (Py := Rabs_pos (ex v (Y p))).
  assert (Pz := Rabs_pos (ex v (Z' p))).
  assert (Nx := mag_pos v (X n)). assert (Ny := mag_pos v (Y n)). assert (Nz := mag_pos v (Z' n)).
  unfold tdot. cbn [ring_expr depth mag room]. rewrite Mx, My, Mz, Ox, Oy, Oz.
  assert (N := eta_pos).
  assert (B1 := mag_product _ _ _ _ (conj Px A1) (conj Nx Mx')).
  assert (B2 := mag_product _ _ _ _ (conj Py A2) (conj Ny My')).
  assert (B3 := mag_product _ _ _ _ (conj Pz A3) (conj Nz Mz')).
  assert (C1 := Rmult_le_compat_l _ _ _ Px Ox'). assert (C2 := Rmult_le_compat_l _ _ _ Py Oy').
  assert (C3 := Rmult_le_compat_l _ _ _ Pz Oz').
  assert (E1 := Rmult_le_compat_r _ _ _ (Rlt_le _ _ N) A1).
  assert (E2 := Rmult_le_compat_r _ _ _ (Rlt_le _ _ N) A2).
  assert (E3 := Rmult_le_compat_r _ _ _ (Rlt_le _ _ N) A3).
  repeat split; auto; try lia; lra.
Qed.

(** A slope, and the value in the middle. Where the form does not move with r, slopes are 0. *)
Notation sigma c := (ex v (c (slope f))).
Lemma k_zero : Rabs k = 0 -> times f = 0%Z.
Proof.
  intros H. destruct (Z.eq_dec (times f) 0) as [E|E]; [exact E|].
  exfalso. apply (Rabs_no_R0 k); [now apply not_0_IZR | exact H].
Qed.
Lemma slope_of (c : tvec -> expr) : (forall a t, c (ttimes t a) = Mul t (c a)) -> component v M (c n) ->
  Rabs (s c - sigma c) <= Rabs k * (11 * u * M + 8 * eta) /\ Rabs (sigma c) <= Rabs k * (2 * M).
Proof.
  intros C (R & D & B & O). unfold slope. rewrite C. assert (U := u_pos). assert (N := eta_pos).
  assert (K0 : Rabs (IZR (times f) * bpow radix2 0) = Rabs k) by (cbn [bpow]; now rewrite Rmult_1_r).
  destruct k_one as [Z|Z].
  - rewrite Z. apply k_zero in Z. rewrite Z. cbn [value]. rewrite !Rmult_0_l, rnd_0, Rminus_0_r, Rabs_R0. lra.
  - rewrite Z, Rmult_1_l. split.
    + assert (F : is_float (IZR (times f) * bpow radix2 0))
        by (destruct few as [-> | [-> | ->]]; now apply number_float).
      assert (H := from_room (Mul (Num (times f) 0) (c n)) (5 + / 2) (3 * eta)).
      cbn [mag room ex value] in H. rewrite K0, Z, !Rmult_1_l in H.
      assert (Hm : (5 + / 2) * u * mag v (c n) <= (5 + / 2) * u * (2 * M)) by (apply Rmult_le_compat_l; lra).
      eapply Rle_trans; [apply H|]; try lra; [now split | apply A_5; simpl; lia].
    + cbn [value]. rewrite Rabs_mult, K0, Z, Rmult_1_l. eapply Rle_trans; [apply (ex_le_mag v _ R) | lra].
Qed.
Lemma slope_near : forall c, c = X \/ c = Y \/ c = Z' ->
  Rabs (s c - sigma c) <= Rabs k * (11 * u * M + 8 * eta) /\ Rabs (sigma c) <= Rabs k * (2 * M).
Proof.
  destruct vectors as (HX & HY & HZ).
  intros c [-> | [-> | ->]]; apply slope_of; auto; reflexivity.
Qed.
Lemma value_near : Rabs (fl v (value_of f) - ex v (value_of f)) <= 60 * u * (M * K) + 20 * eta * (1 + K) /\
  Rabs (ex v (value_of f)) <= 6 * (M * K).
Proof.
  destruct fixed_room as (R & D & B & O). assert (U := u_pos). assert (N := eta_pos).
  assert (LP := L_pos). assert (PP := most_pos v p).
  assert (Hmp : 0 <= M * P) by (apply Rmult_le_pos; lra).
  assert (Hnp : 0 <= eta * P) by (apply Rmult_le_pos; lra).
  assert (Hnl : 0 <= eta * L) by (apply Rmult_le_pos; lra).
  destruct k_one as [Z|Z].
  - (* slopes are 0 *)
    assert (E : fl v (value_of f) = fl v fixed /\ ex v (value_of f) = ex v fixed).
    { apply k_zero in Z. unfold value_of, slope, ttimes. rewrite Z. split.
      - unfold tdot at 2. cbn [value X Y Z' fst snd].
        rewrite !Rmult_0_l, ?rnd_0, ?Rmult_0_l, ?rnd_0, ?Rplus_0_r, ?rnd_0, ?Rplus_0_r.
        apply rnd_id, (fl_float v floats), R.
      - unfold tdot. cbn [value X Y Z' fst snd]. ring. }
    destruct E as [-> ->]. rewrite Z, Rmult_0_l, Rplus_0_r. split.
    + eapply Rle_trans; [apply (from_room fixed 10 (eta * (6 * P + 3))); auto; try lra;
        apply A_9; lia|].
      assert (10 * u * mag v fixed <= 10 * u * (6 * (M * P))) by (apply Rmult_le_compat_l; lra). lra.
    + eapply Rle_trans; [apply (ex_le_mag v _ R) | lra].
  - rewrite Z, Rmult_1_l.
    destruct vectors as ((Rx' & Dx' & Mx' & Ox') & (Ry' & Dy' & My' & Oy') & (Rz' & Dz' & Mz' & Oz')).
    assert (K0 : Rabs (IZR (times f) * bpow radix2 0) = 1) by (cbn [bpow]; now rewrite Rmult_1_r).
    assert (F : is_float (IZR (times f) * bpow radix2 0))
      by (destruct few as [-> | [-> | ->]]; now apply number_float).
    destruct middle_small as (m1 & m2 & m3).
    cbn [middle vector_named value X Y Z' fst snd append] in m1, m2, m3.
    assert (Nx := mag_pos v (X n)). assert (Ny := mag_pos v (Y n)). assert (Nz := mag_pos v (Z' n)).
    set (x := r_var v "middlex") in *. set (y := r_var v "middley") in *. set (z := r_var v "middlez") in *.
    assert (Q1 := Rabs_pos x). assert (Q2 := Rabs_pos y). assert (Q3 := Rabs_pos z).
    assert (B1 := mag_product _ _ _ _ (conj Nx Mx') (conj Q1 m1)).
    assert (B2 := mag_product _ _ _ _ (conj Ny My') (conj Q2 m2)).
    assert (B3 := mag_product _ _ _ _ (conj Nz Mz') (conj Q3 m3)).
    assert (C1 := Rmult_le_compat_r _ _ _ Q1 Ox'). assert (C2 := Rmult_le_compat_r _ _ _ Q2 Oy').
    assert (C3 := Rmult_le_compat_r _ _ _ Q3 Oz').
    assert (E1 := Rmult_le_compat_l _ _ _ (Rlt_le _ _ N) m1).
    assert (E2 := Rmult_le_compat_l _ _ _ (Rlt_le _ _ N) m2).
    assert (E3 := Rmult_le_compat_l _ _ _ (Rlt_le _ _ N) m3).
    assert (RV : ring_expr (value_of f)) by (split; [exact R | now repeat split]).
    assert (MV : mag v (value_of f) <= 6 * (M * (P + L))).
    { unfold value_of. cbn [mag]. unfold tdot at 2, slope, ttimes.
      cbn [mag X Y Z' fst snd middle vector_named append].
      fold (X n) (Y n) (Z' n). cbn [value]. rewrite K0. fold x y z. lra. }
    split; [|eapply Rle_trans; [apply (ex_le_mag v _ RV) | exact MV]].
    eapply Rle_trans; [apply (from_room (value_of f) 10 (eta * (6 * P + 9 * L + 6))); auto; try lra|].
    + apply A_9. unfold value_of, tdot at 2, slope, ttimes. cbn [depth X Y Z' fst snd middle vector_named].
      fold (X n) (Y n) (Z' n). lia.
    + unfold value_of. cbn [mag room]. unfold tdot at 2 4, slope, ttimes.
      cbn [mag room X Y Z' fst snd middle vector_named append]. fold (X n) (Y n) (Z' n). cbn [value].
      rewrite K0. fold x y z. lra.
    + assert (10 * u * mag v (value_of f) <= 10 * u * (6 * (M * (P + L)))) by (apply Rmult_le_compat_l; lra).
      lra.
Qed.

(** The error as computed is at least 510 u of the size, and has room for underflow. *)
Lemma error_low : 510 * u * (M * K) + bpow radix2 (-1043) * (1 + K) <= fl v (error_of f).
Proof.
  assert (U := u_pos). assert (Us := u_small). assert (N := eta_pos). assert (KP := K_pos).
  assert (PP := most_pos v p).
  assert (LP := L_pos). assert (kP := Rabs_pos k).
  unfold error_of, away. cbn [value].
  replace (IZR (Z.abs (times f)) * bpow radix2 0) with (Rabs k)
    by (rewrite abs_IZR; cbn [bpow]; now rewrite Rmult_1_r).
  assert (T : rnd (Rabs k * L) = Rabs k * L).
  { apply rnd_id. destruct k_one as [-> | ->]; [rewrite Rmult_0_l;
      apply generic_format_0 | rewrite Rmult_1_l; apply floats]. }
  rewrite T. assert (MP := most_atoms v floats p points).
  assert (FM : is_float (fl v (tmost p))).
  { cbn [tmost value]. destruct points as ((Rx & _) & (Ry & _) & (Rz & _)).
    unfold Rmax. repeat destruct Rle_dec; apply is_float_abs, (fl_float v floats); assumption. }
  assert (0 <= Rabs k * L) by (apply Rmult_le_pos; lra).
  set (W := fl v (tmost p)) in *. assert (0 <= W) by nra.
  assert (FL : is_float (Rabs k * L)) by (rewrite <- T; apply rnd_float).
  assert (R1 := rnd_low_sum W (Rabs k * L) FM FL ltac:(lra)).
  set (r := rnd (W + Rabs k * L)) in *.
  assert (K1 : (1 - 2 * u) * K <= r) by nra.
  assert (r0 : 0 <= r) by nra.
  set (S := fl v (size f)) in *.
  assert (S0 : 0 <= r * S) by (apply Rmult_le_pos; assumption).
  assert (R2 := rnd_low (r * S) S0).
  (* from the product of the true sizes *)
  assert (R3 : (1 - 2 * u) * K * ((1 - 4 * u) * M - eta) <= r * S).
  { apply Rle_trans with ((1 - 2 * u) * K * S); [apply Rmult_le_compat_l; [apply Rmult_le_pos;
      lra | exact size_low] |
      apply Rmult_le_compat_r; assumption]. }
  assert (MK : 0 <= M * K) by (apply Rmult_le_pos; lra).
  assert (NK : 0 <= eta * K) by (apply Rmult_le_pos; lra).
  assert (0 <= u * (M * K)) by (apply Rmult_le_pos; lra).
  assert (0 <= u * (u * (M * K))) by (apply Rmult_le_pos; lra).
  assert (0 <= u * (eta * K)) by (apply Rmult_le_pos; lra).
  assert (R4 : (1 - 6 * u) * (M * K) - eta * K <= r * S) by lra.
  assert (R5 : (1 - 7 * u) * (M * K) - eta * K - eta <= rnd (r * S)).
  { assert ((1 - u) * ((1 - 6 * u) * (M * K) - eta * K) <= (1 - u) * (r * S)) by (apply Rmult_le_compat_l;
      lra).
    lra. }
  assert (G0 : 0 <= rnd (r * S)) by now apply rnd_pos.
  assert (B44 : 1 * bpow radix2 (-44) = 512 * u) by (unfold u; simpl; lra). rewrite B44.
  assert (R6 := rnd_low (512 * u * rnd (r * S)) ltac:(apply Rmult_le_pos; lra)).
  assert (R7 : 511 * u * (M * K) - eta * K - 2 * eta <= rnd (512 * u * rnd (r * S))).
  { assert (Q : (1 - u) * (512 * u) * ((1 - 7 * u) * (M * K) - eta * K - eta) <= (1 - u) * (512 * u) * rnd (r
      * S))
      by (apply Rmult_le_compat_l; [apply Rmult_le_pos; lra | lra]).
    assert (u * (u * (M * K)) <= / 10000000 * (u * (M * K))) by (apply Rmult_le_compat_r; lra).
    assert (0 <= u * (u * (u * (M * K)))) by (apply Rmult_le_pos; lra).
    assert (u * (eta * K) <= / 10000000 * (eta * K)) by (apply Rmult_le_compat_r; lra).
    assert (0 <= u * (u * (eta * K))) by (apply Rmult_le_pos; lra).
    assert (u * eta <= / 10000000 * eta) by (apply Rmult_le_compat_r; lra).
    assert (0 <= u * (u * eta)) by (apply Rmult_le_pos; [lra|]; apply Rmult_le_pos; lra).
    lra. }
  replace (1 * bpow radix2 0) with 1 by (simpl; ring). rewrite Rmult_1_l.
  assert (One : is_float 1) by (replace 1 with (1 * bpow radix2 0) by (simpl; ring); apply float_one).
  assert (R8 := rnd_low_sum 1 r One (rnd_float _) ltac:(lra)).
  destruct tiny as (w0 & -> & W1). set (w := bpow radix2 (-1040)) in *.
  assert (C1 : 0 <= rnd (1 + r)) by (apply rnd_pos; lra).
  assert (R9 := rnd_low (w * rnd (1 + r)) ltac:(apply Rmult_le_pos; lra)).
  assert (wK : 0 <= w * K) by (apply Rmult_le_pos; lra).
  assert (u * w <= / 10000000 * w) by (apply Rmult_le_compat_r; lra).
  assert (u * (w * K) <= / 10000000 * (w * K)) by (apply Rmult_le_compat_r; lra).
  assert (0 <= u * (u * w)) by (apply Rmult_le_pos; [lra|]; apply Rmult_le_pos; lra).
  assert (0 <= u * (w * K)) by (apply Rmult_le_pos; lra).
  assert (0 <= u * (u * (w * K))) by (apply Rmult_le_pos; lra).
  assert (R10 : w * ((1 - u) * (1 + (1 - 2 * u) * K)) <= w * rnd (1 + r)).
  { apply Rmult_le_compat_l; [lra|]. apply Rle_trans with ((1 - u) * (1 + r)); [|exact R8].
    apply Rmult_le_compat_l; lra. }
  assert (R11 : w / 2 * (1 + K) <= w * rnd (1 + r)) by lra.
  assert (R12 : w / 3 * (1 + K) <= rnd (w * rnd (1 + r))).
  { assert ((1 - u) * (w / 2 * (1 + K)) <= (1 - u) * (w * rnd (1 + r))) by (apply Rmult_le_compat_l; lra).
    lra. }
  set (a := rnd (512 * u * rnd (r * S))) in *. set (b := rnd (w * rnd (1 + r))) in *.
  assert (a0 : 0 <= a) by (apply rnd_pos, Rmult_le_pos; lra).
  assert (R13 := rnd_low_sum a b (rnd_float _) (rnd_float _) ltac:(nra)).
  assert (EK : eta * K = w * K / 34359738368) by (rewrite W1; field).
  assert (R14 : 511 * u * (M * K) + w / 4 * (1 + K) <= a + b) by lra.
  assert ((1 - u) * (511 * u * (M * K) + w / 4 * (1 + K)) <= (1 - u) * (a + b)) by (apply Rmult_le_compat_l;
    lra).
  assert (u * (u * (M * K)) <= / 10000000 * (u * (M * K))) by (apply Rmult_le_compat_r; lra).
  lra.
Qed.

(** The exact value for a ray in the box, whose r may itself have been rounded, twice at most. *)
Definition exact_at (x y z : R) : R :=
  ex v fixed + k * (ex v (X n) * x + ex v (Y n) * y + ex v (Z' n) * z).
Lemma moved_by sigma s h d e far : Rabs (s - sigma) <= e -> Rabs sigma <= far -> 0 <= h <= 4 * L ->
  Rabs d <= h + 2 * u * L -> 0 <= e ->
  Rabs (sigma * d) <= Rabs s * h + e * (4 * L) + 2 * u * (far * L) /\ Rabs s * h <= (far + e) * (4 * L).
Proof.
  intros E F H D Pe. assert (U := u_pos). assert (LP := L_pos).
  assert (S : Rabs sigma <= Rabs s + e) by (revert E; unfold Rabs; repeat destruct Rcase_abs; lra).
  assert (S' : Rabs s <= far + e) by (revert E F; unfold Rabs; repeat destruct Rcase_abs; lra).
  rewrite Rabs_mult. assert (Ps := Rabs_pos s). assert (Po := Rabs_pos sigma). assert (Pd := Rabs_pos d).
  assert (0 <= 2 * u * L) by (apply Rmult_le_pos; lra). split.
  - apply Rle_trans with (Rabs sigma * (h + 2 * u * L)); [apply Rmult_le_compat_l; assumption|].
    assert (Rabs sigma * h <= (Rabs s + e) * h) by (apply Rmult_le_compat_r; lra).
    assert (e * h <= e * (4 * L)) by (apply Rmult_le_compat_l; lra).
    assert (Rabs sigma * (2 * u * L) <= far * (2 * u * L)) by (apply Rmult_le_compat_r; lra). lra.
  - apply Rmult_le_compat; lra.
Qed.
Lemma dot_low sx sy sz hx hy hz : is_float sx -> is_float sy -> is_float sz -> 0 <= hx -> 0 <= hy ->
  0 <= hz ->
  (1 - 3 * u) * (Rabs sx * hx + Rabs sy * hy + Rabs sz * hz) - 4 * eta <=
  rnd (rnd (rnd (Rabs sx * hx) + rnd (Rabs sy * hy)) + rnd (Rabs sz * hz)).
Proof.
  intros Fx Fy Fz Hx Hy Hz. assert (U := u_pos). assert (Us := u_small). assert (N := eta_pos).
  assert (Px : 0 <= Rabs sx * hx) by (apply Rmult_le_pos; auto using Rabs_pos).
  assert (Py : 0 <= Rabs sy * hy) by (apply Rmult_le_pos; auto using Rabs_pos).
  assert (Pz : 0 <= Rabs sz * hz) by (apply Rmult_le_pos; auto using Rabs_pos).
  set (x := Rabs sx * hx) in *. set (y := Rabs sy * hy) in *. set (z := Rabs sz * hz) in *.
  assert (Rx := rnd_low x Px). assert (Ry := rnd_low y Py). assert (Rz := rnd_low z Pz).
  assert (Qx := rnd_pos x Px). assert (Qy := rnd_pos y Py). assert (Qz := rnd_pos z Pz).
  assert (R1 := rnd_low_sum _ _ (rnd_float x) (rnd_float y) ltac:(lra)).
  assert (Q1 : 0 <= rnd (rnd x + rnd y)) by (apply rnd_pos; lra).
  assert (R2 := rnd_low_sum _ _ (rnd_float (rnd x + rnd y)) (rnd_float z) ltac:(lra)).
  assert (I1 : (1 - u) * ((1 - u) * x - eta + ((1 - u) * y - eta)) <= (1 - u) * (rnd x + rnd y))
    by (apply Rmult_le_compat_l; lra).
  assert (I2 : (1 - u) * ((1 - u) * ((1 - u) * x - eta + ((1 - u) * y - eta)) + ((1 - u) * z - eta)) <=
    (1 - u) * (rnd (rnd x + rnd y) + rnd z)) by (apply Rmult_le_compat_l; lra).
  assert (0 <= u * x) by (apply Rmult_le_pos; lra). assert (0 <= u * y) by (apply Rmult_le_pos; lra).
  assert (0 <= u * z) by (apply Rmult_le_pos; lra). assert (0 <= u * eta) by (apply Rmult_le_pos; lra).
  assert (u * (u * x) <= u * x) by nra. assert (u * (u * y) <= u * y) by nra.
  assert (u * (u * z) <= u * z) by nra. assert (u * (u * eta) <= u * eta) by nra.
  assert (0 <= u * (u * x)) by (apply Rmult_le_pos; lra).
  assert (0 <= u * (u * y)) by (apply Rmult_le_pos; lra).
  assert (0 <= u * (u * z)) by (apply Rmult_le_pos; lra).
  assert (0 <= u * (u * eta)) by (apply Rmult_le_pos; lra).
  assert (u * (u * (u * x)) <= u * (u * x)) by nra. assert (u * (u * (u * y)) <= u * (u * y)) by nra.
  assert (u * (u * (u * z)) <= u * (u * z)) by nra.
  lra.
Qed.
Theorem form_near x y z :
  Rabs (x - m X) <= h X + 2 * u * L -> Rabs (y - m Y) <= h Y + 2 * u * L ->
    Rabs (z - m Z') <= h Z' + 2 * u * L ->
  Rabs (exact_at x y z - fl v (value_of f)) <=
  (1 - 4 * u) * fl v (reach_of f) - 8 * u * Rabs (fl v (value_of f)) - bpow radix2 (-1045).
Proof.
  intros DX DY DZ. assert (U := u_pos). assert (Us := u_small). assert (N := eta_pos). assert (KP := K_pos).
  assert (PP := most_pos v p). assert (LP := L_pos). assert (kP := Rabs_pos k).
  destruct value_near as [V1 V2]. assert (E := error_low).
  destruct half_small as (HX & HY & HZ).
  destruct (slope_near X ltac:(auto)) as [SX FX]. destruct (slope_near Y ltac:(auto)) as [SY FY].
  destruct (slope_near Z' ltac:(auto)) as [SZ FZ].
  set (e := Rabs k * (11 * u * M + 8 * eta)) in *. set (far := Rabs k * (2 * M)) in *.
  assert (Pe : 0 <= e) by (apply Rmult_le_pos; [lra|]; assert (0 <= u * M) by (apply Rmult_le_pos; lra); lra).
  destruct (moved_by _ _ _ _ _ _ SX FX HX DX Pe) as [MX BX].
  destruct (moved_by _ _ _ _ _ _ SY FY HY DY Pe) as [MY BY].
  destruct (moved_by _ _ _ _ _ _ SZ FZ HZ DZ Pe) as [MZ BZ].
  (* the value is linear *)
  assert (Lin : exact_at x y z - ex v (value_of f) =
    sigma X * (x - m X) + sigma Y * (y - m Y) + sigma Z' * (z - m Z')).
  { unfold exact_at, value_of, slope, ttimes, tdot.
    cbn [value X Y Z' fst snd bpow middle vector_named append]. ring. }
  set (W := ex v (value_of f)) in *. set (V := fl v (value_of f)) in *.
  assert (G : Rabs (exact_at x y z - V) <= Rabs (V - W) + Rabs (sigma X * (x - m X)) +
    Rabs (sigma Y * (y - m Y)) + Rabs (sigma Z' * (z - m Z'))).
  { replace (exact_at x y z - V) with ((exact_at x y z - W) - (V - W)) by ring. rewrite Lin.
    unfold Rabs. repeat destruct Rcase_abs; lra. }
  assert (VW : Rabs V <= Rabs W + Rabs (V - W)) by (unfold Rabs; repeat destruct Rcase_abs; lra).
  assert (FS : forall c, c = X \/ c = Y \/ c = Z' -> is_float (s c)).
  { intros c [-> | [-> | ->]]; apply rnd_float. }
  assert (D := dot_low (s X) (s Y) (s Z') (h X) (h Y) (h Z') ltac:(auto) ltac:(auto) ltac:(auto)
    ltac:(lra) ltac:(lra) ltac:(lra)).
  change (fl v (reach_of f)) with (rnd (fl v (error_of f) + rnd (rnd (rnd (Rabs (s X) * h X) +
    rnd (Rabs (s Y) * h Y)) + rnd (Rabs (s Z') * h Z')))).
  set (H := rnd (rnd (rnd (Rabs (s X) * h X) + rnd (Rabs (s Y) * h Y)) + rnd (Rabs (s Z') * h Z'))) in *.
  set (sum := Rabs (s X) * h X + Rabs (s Y) * h Y + Rabs (s Z') * h Z') in *.
  set (ef := fl v (error_of f)) in *.
  assert (H0 : 0 <= H).
  { unfold H. repeat (apply rnd_pos; repeat apply Rplus_le_le_0_compat; try (apply Rmult_le_pos;
      [apply Rabs_pos | lra])). }
  assert (Fe : is_float ef) by apply rnd_float.
  assert (MK : 0 <= M * K) by (apply Rmult_le_pos; lra).
  assert (B0 : 0 <= Rabs k * L) by (apply Rmult_le_pos; lra).
  set (B := Rabs k * L) in *.
  assert (MB : 0 <= M * B) by (apply Rmult_le_pos; lra).
  assert (MB' : M * B <= M * (P + B)) by (apply Rmult_le_compat_l; lra).
  assert (e4 : e * (4 * L) = 44 * (u * (M * B)) + 32 * (eta * B)) by (unfold e, B; ring).
  assert (f4 : far * L = 2 * (M * B)) by (unfold far, B; ring).
  assert (f5 : (far + e) * (4 * L) = 8 * (M * B) + 44 * (u * (M * B)) + 32 * (eta * B)) by (unfold far, e, B;
    ring).
  rewrite f5 in *. rewrite e4, f4 in *. set (q := M * B) in *. set (r := M * (P + B)) in *.
  destruct tiny as (w0 & W0 & W1).
  replace (bpow radix2 (-1045)) with (bpow radix2 (-1040) / 32)
    by (replace (-1045)%Z with (-1040 + -5)%Z by lia; rewrite bpow_plus;
      change (bpow radix2 (-5)) with (/ 32); lra).
  rewrite W0 in *. set (w := bpow radix2 (-1040)) in *.
  assert (wB : 0 <= w * B) by (apply Rmult_le_pos; lra).
  assert (wP : 0 <= w * P) by (apply Rmult_le_pos; lra).
  assert (EB : eta * B = w * B / 34359738368) by (rewrite W1; field).
  assert (EP : eta * P = w * P / 34359738368) by (rewrite W1; field).
  assert (sum0 : 0 <= sum).
  { unfold sum. repeat apply Rplus_le_le_0_compat; apply Rmult_le_pos; auto using Rabs_pos; lra. }
  assert (S1 : sum <= 24 * q + 132 * (u * q) + 96 * (eta * B)) by (unfold sum; lra).
  assert (G1 : Rabs (exact_at x y z - V) <= Rabs (V - W) + sum + 144 * (u * q) + 96 * (eta * B))
    by (unfold sum; lra).
  assert (uq : 0 <= u * q) by (apply Rmult_le_pos; lra).
  assert (ur : 0 <= u * r) by (apply Rmult_le_pos; lra).
  assert (uq' : u * q <= u * r) by (apply Rmult_le_compat_l; lra).
  assert (uuq := small_share _ uq). assert (uur := small_share _ ur). assert (uwB := small_share _ wB).
  assert (uwP := small_share _ wP).
  assert (uw := small_share w ltac:(lra)).
  assert (u8 : 8 * u * Rabs V <= 8 * u * (6 * r + (60 * u * r + 20 * eta * (1 + (P + B)))))
    by (apply Rmult_le_compat_l; lra).
  assert (E1 : 510 * u * r + w / 8 * (1 + (P + B)) <= ef) by exact E.
  assert (us := small_share _ sum0).
  assert (us1 : u * sum <= u * (24 * q + 132 * (u * q) + 96 * (eta * B))) by (apply Rmult_le_compat_l; lra).
  assert (F1 := rnd_low_sum ef H Fe (rnd_float _) ltac:(lra)).
  set (t := rnd (ef + H)) in *.
  assert (F2 : (1 - 5 * u) * (ef + H) <= (1 - 4 * u) * t).
  { assert (0 <= u * (u * (ef + H))) by (apply Rmult_le_pos; [lra|]; apply Rmult_le_pos; lra).
    assert ((1 - 4 * u) * ((1 - u) * (ef + H)) <= (1 - 4 * u) * t) by (apply Rmult_le_compat_l; lra). lra. }
  assert (F3 : (1 - 5 * u) * (510 * u * r + w / 8 * (1 + (P + B)) + ((1 - 3 * u) * sum - 4 * eta)) <=
    (1 - 5 * u) * (ef + H)) by (apply Rmult_le_compat_l; lra).
  assert (uus := small_share (u * sum) ltac:(lra)). assert (ue := small_share eta ltac:(lra)).
  assert (uEB := small_share (eta * B) ltac:(lra)). assert (uEP := small_share (eta * P) ltac:(lra)).
  assert (uuEB := small_share (u * (eta * B)) ltac:(lra)).
  assert (uuEP := small_share (u * (eta * P)) ltac:(lra)).
  assert (uuur := small_share (u * (u * r)) ltac:(lra)).
  assert (uuuq := small_share (u * (u * q)) ltac:(lra)).
  assert (uue := small_share (u * eta) ltac:(lra)).
  lra.
Qed.
End Form.
