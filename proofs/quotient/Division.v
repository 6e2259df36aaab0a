(** The quotient step of [quotient.py], coarsely: what it means that the test is passed.

    T and D are real numbers, known as sums of two floats but for a little less than e_T and e_D.
    [size_T] stands for V N, in the docstring's words, and [size_D] likewise (with its own V): the
    second floats are at most 2^-23 of it (the docstring: 6 2^-26), the sums at most 4 of it (3.1),
    and e_T exceeds the error of T1 + T2 by at least 2^-73 size_T (2^-72 - 2^-73.5). That the scalar
    products fulfil this is proved in [Quotient.v].

    Everything is computed in real numbers, rounded as if there were no largest float. Nothing may
    be assumed yet of how large T and D are, compared with their errors: that is what the test tells
    ([test_limits]: E <= 2^-52 |t|). [Ziv.v] goes on from there. *)
Require Import ZArith Reals Psatz Bool.
From Reftrace Require Import Trees Rounding Digits.
From Flocq Require Import Core.
Open Scope R_scope.

(** All that is assumed, in one record; it is found by itself where it is needed. *)
Class case := Case {
  T : R; D : R; high : R; low : R; high_error : R;
  under : R; rest : R; under_error : R; size_T : R; size_D : R;
  F_high : is_float high; F_low : is_float low; F_high_error : is_float high_error;
  F_under : is_float under; F_rest : is_float rest; F_under_error : is_float under_error;
  T_error : Rabs (T - (high + low)) + pow2 (-73) * size_T <= high_error;
  D_error : Rabs (D - (under + rest)) + pow2 (-73) * size_D <= under_error;
  T_rest : Rabs low <= pow2 (-23) * size_T;
  D_rest : Rabs rest <= pow2 (-23) * size_D;
  T_size : Rabs (high + low) <= 4 * size_T;
  D_size : Rabs (under + rest) <= 4 * size_D;
  (* What [_error] sees to: neither e is less than _LEAST 2^-72, and V N is less than _MOST. *)
  T_least : pow2 (-1022) <= high_error;
  D_least : pow2 (-1022) <= under_error;
  D_most : size_D <= pow2 1001
}.

Section Case.
Context {c : case}.
Definition DS := under + rest.
Definition TS := high + low.
Definition inverse := rnd (1 / rnd (under + rest)).
Definition first := rnd (rnd (high + low) * inverse).
Definition near := highest first.
Definition top := highest under.
Definition x1 := rnd (near * top).
Definition d2 := rnd (under - top).
Definition x2 := rnd (near * d2).
Definition x3 := rnd (near * rest).
Definition l1 := rnd (high - x1).
Definition l2 := rnd (l1 - x2).
Definition s := rnd (low - x3).
Definition l3 := rnd (l2 + s).
Definition left := rnd (l3 * inverse).
Definition e1 := rnd (Rabs first * under_error).
Definition e2 := rnd (e1 + high_error).
Definition e3 := rnd (e2 * Rabs inverse).
Definition error := rnd (e3 * (4548635623644201 * pow2 (-52))).
Definition lower := rnd (left - error).
Definition upper := rnd (left + error).
End Case.

(** It passes the test. *)
Class passes (c : case) := Passes {
  not_small : pow2 (-950) < Rabs first;
  same : rnd (lower + near) = rnd (upper + near)
}.

(** What is assumed, as hypotheses that linear arithmetic sees. *)
Ltac given :=
  assert (T_error := T_error); assert (D_error := D_error); assert (T_rest := T_rest);
  assert (D_rest := D_rest); assert (T_size := T_size); assert (D_size := D_size);
  assert (T_least := T_least); assert (D_least := D_least); assert (D_most := D_most);
  assert (F_high := F_high); assert (F_low := F_low); assert (F_high_error := F_high_error);
  assert (F_under := F_under); assert (F_rest := F_rest); assert (F_under_error := F_under_error);
  assert (not_small := not_small); assert (same := same).

Section Coarse.
Context {c : case} {p : passes c}.

(** *** The first quotient *)

Lemma DS_not_0 : DS <> 0.
Proof.
  given.
  intros Z. revert not_small. unfold first, inverse. fold DS. rewrite Z, rnd_0. unfold Rdiv.
  rewrite Rinv_0, Rmult_0_r, rnd_0, Rmult_0_r, rnd_0, Rabs_R0. generalize (pow2_pos (-950)). lra.
Qed.
Lemma TS_not_0 : TS <> 0.
Proof.
  given.
  intros Z. revert not_small. unfold first. fold TS.
  rewrite Z, rnd_0, Rmult_0_l, rnd_0, Rabs_R0. generalize (pow2_pos (-950)). lra.
Qed.

(** The inverse has all its digits, as |D| is not too large. *)
Lemma inverse_near : Rabs (inverse * DS - 1) <= 3 * U.
Proof.
  given.
  assert (N := DS_not_0). set (i0 := rnd (under + rest)).
  assert (H : Rabs (i0 - DS) <= U * Rabs DS) by (apply off_sum; auto; apply Rle_refl).
  assert (P : 0 < Rabs DS) by now apply Rabs_pos_lt.
  assert (N0 : i0 <> 0).
  { intros Z. revert H. rewrite Z, Rminus_0_l, Rabs_Ropp. lra. }
  assert (B : Rabs i0 <= pow2 1003).
  { apply rnd_le_pow2; [lia|]. eapply Rle_trans; [exact D_size|].
    change 1003%Z with (2 + 1001)%Z. rewrite bpow_plus. simpl (pow2 2). lra. }
  assert (I : Rabs (inverse - 1 / i0) <= U * Rabs (1 / i0)).
  { rewrite <- u_U. apply rnd_err_rel. unfold Rdiv. rewrite Rmult_1_l, Rabs_inv.
    apply Rle_trans with (/ pow2 1003).
    - rewrite <- bpow_opp. apply pow2_le. lia.
    - apply Rinv_le; [now apply Rabs_pos_lt | exact B]. }
  apply ratio in I; [|unfold Rdiv; rewrite Rmult_1_l; now apply Rinv_neq_0_compat].
  assert (J : Rabs (DS / i0 - 1) <= 3 / 2 * U).
  { apply ratio; [exact N0|]. revert H. unfold Rabs. repeat destruct Rcase_abs; lra. }
  replace (inverse * DS) with (inverse / (1 / i0) * (DS / i0)) by (field; exact N0).
  eapply Rle_trans; [apply (near_1 _ _ _ _ I J)|]. lra.
Qed.

Lemma first_near : Rabs (first * DS - TS) <= 6 * U * Rabs TS.
Proof.
  given.
  assert (N := DS_not_0). assert (M := TS_not_0).
  assert (H : Rabs (rnd (high + low) - TS) <= U * Rabs TS) by (apply off_sum; auto; apply Rle_refl).
  apply ratio in H; [|exact M].
  assert (B : pow2 (-951) < Rabs (rnd (high + low) * inverse)).
  { apply Rnot_le_lt. intros L. apply (rnd_le_pow2 (-951)) in L; [|lia]. fold first in L.
    assert (pow2 (-951) <= pow2 (-950)) by (apply pow2_le; lia). lra. }
  assert (I : Rabs (first - rnd (high + low) * inverse) <= U * Rabs (rnd (high + low) * inverse)).
  { rewrite <- u_U. apply rnd_err_rel. apply Rlt_le. eapply Rle_lt_trans; [|exact B]. now apply pow2_le. }
  apply ratio in I.
  2:{ intros Z. revert B. rewrite Z, Rabs_R0. generalize (pow2_pos (-951)). lra. }
  assert (K := near_1 _ _ _ _ (near_1 _ _ _ _ H inverse_near) I).
  assert (N1 : rnd (high + low) <> 0).
  { intros Z. revert B. rewrite Z, Rmult_0_l, Rabs_R0. generalize (pow2_pos (-951)). lra. }
  assert (N2 : inverse <> 0).
  { intros Z. revert B. rewrite Z, Rmult_0_r, Rabs_R0. generalize (pow2_pos (-951)). lra. }
  replace (first * DS - TS)
    with (TS * (rnd (high + low) / TS * (inverse * DS) * (first / (rnd (high + low) * inverse)) - 1))
    by (field; auto).
  rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos|]. lra.
Qed.

(** *** Sizes, times |D1 + D2|: every bound below is linear in these *)

Definition S := Rabs TS.
Definition g := S / Rabs DS. (* about |t| *)
Definition w := size_T + g * size_D.
Definition P := high_error + g * under_error. (* E is about P / |D1 + D2| *)

Lemma S_pos : 0 < S. Proof. given. apply Rabs_pos_lt, TS_not_0. Qed.
Lemma DS_pos : 0 < Rabs DS. Proof. given. apply Rabs_pos_lt, DS_not_0. Qed.
Lemma S_g : S = g * Rabs DS.
Proof. given. unfold g. field. apply Rgt_not_eq, DS_pos. Qed.
Lemma g_pos : 0 < g.
Proof. given. apply Rdiv_lt_0_compat; [exact S_pos | exact DS_pos]. Qed.
Lemma g_mono a b : a <= b -> g * a <= g * b.
Proof. given. apply Rmult_le_compat_l, Rlt_le, g_pos. Qed.

Lemma sizes : S <= 4 * size_T /\ S <= 4 * (g * size_D) /\ pow2 (-73) * w <= P /\
  eta <= pow2 (-53) * high_error /\ g * eta <= pow2 (-53) * (g * under_error).
Proof.
  given.
  repeat split.
  - exact T_size.
  - rewrite S_g. apply (g_mono _ _ D_size) || (generalize (g_mono _ _ D_size); unfold DS; lra).
  - unfold w, P. generalize (Rabs_pos (T - (high + low))) (Rabs_pos (D - (under + rest))).
    intros H1 H2. assert (H : pow2 (-73) * size_D <= under_error) by lra. apply g_mono in H. lra.
  - now apply (eta_le (-1022)).
  - rewrite <- Rmult_assoc, (Rmult_comm _ g), Rmult_assoc. apply g_mono. now apply (eta_le (-1022)).
Qed.

Lemma P_pos : 0 < P.
Proof.
  given.
  apply Rplus_lt_0_compat; [|apply Rmult_lt_0_compat; [exact g_pos|]];
    (eapply Rlt_le_trans; [apply (pow2_pos (-1022))|]); auto.
Qed.

Lemma first_large : pow2 (-1022) <= Rabs first.
Proof. given. apply Rlt_le. eapply Rle_lt_trans; [|exact not_small]. apply pow2_le. lia. Qed.

Lemma near_near : Rabs (near * DS - TS) <= (/ 33554432 + 8 * U) * S.
Proof.
  given.
  assert (H := highest_near first (rnd_float _) first_large). fold near in H. rewrite pow2_m25 in H.
  assert (I := first_near). fold S in I.
  assert (J : Rabs (first * DS) <= (1 + 6 * U) * S).
  { replace (first * DS) with (first * DS - TS + TS) by ring. eapply Rle_trans; [apply Rabs_triang|].
    fold S. lra. }
  assert (K : Rabs ((first - near) * DS) <= / 33554432 * Rabs (first * DS)).
  { rewrite 2!Rabs_mult, <- Rmult_assoc. apply Rmult_le_compat_r; [apply Rabs_pos | exact H]. }
  replace (near * DS - TS) with (first * DS - TS + - ((first - near) * DS)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. generalize S_pos. lra.
Qed.

Lemma near_size x : Rabs (near * x) <= (1 + / 16777216) * (g * Rabs x).
Proof.
  given.
  rewrite Rabs_mult, <- Rmult_assoc. apply Rmult_le_compat_r; [apply Rabs_pos|].
  apply Rmult_le_reg_r with (Rabs DS); [exact DS_pos|].
  rewrite Rmult_assoc, <- S_g, <- Rabs_mult.
  replace (near * DS) with (near * DS - TS + TS) by ring. eapply Rle_trans; [apply Rabs_triang|].
  generalize near_near S_pos. fold S. lra.
Qed.

Lemma eta_DS : eta * Rabs DS <= / 1000000000000000000000000000000000000 * S.
Proof.
  given.
  assert (J : pow2 (-950) * Rabs DS <= 2 * S).
  { apply Rle_trans with (Rabs first * Rabs DS).
    - apply Rmult_le_compat_r; [apply Rabs_pos | now apply Rlt_le].
    - rewrite <- Rabs_mult. replace (first * DS) with (first * DS - TS + TS) by ring.
      eapply Rle_trans; [apply Rabs_triang|]. generalize first_near S_pos. fold S. lra. }
  replace eta with (pow2 (-125) * pow2 (-950)).
  2:{ rewrite <- bpow_plus. change (-125 + -950)%Z with (-1074 - 1)%Z. now rewrite pow2_half. }
  rewrite Rmult_assoc. apply Rle_trans with (pow2 (-125) * (2 * S)).
  - apply Rmult_le_compat_l; [apply bpow_ge_0 | exact J].
  - rewrite <- Rmult_assoc. apply Rmult_le_compat_r; [apply Rlt_le, S_pos|]. simpl. lra.
Qed.

(** The last product but one: by the inverse. *)
Lemma left_near : Rabs (left * DS - l3) <= 5 * U * Rabs l3 + eta * Rabs DS.
Proof.
  given.
  assert (I := inverse_near).
  assert (H : Rabs (left - l3 * inverse) <= U * Rabs (l3 * inverse) + eta)
    by (apply off_any, Rle_refl).
  assert (J : Rabs (l3 * (inverse * DS - 1)) <= 3 * U * Rabs l3).
  { rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos | exact I]. }
  assert (K : Rabs ((left - l3 * inverse) * DS) <= U * Rabs (l3 * (inverse * DS)) + eta * Rabs DS).
  { rewrite Rabs_mult, <- Rmult_assoc, (Rabs_mult _ DS).
    rewrite <- (Rmult_assoc U), <- Rmult_plus_distr_r.
    apply Rmult_le_compat_r; [apply Rabs_pos | exact H]. }
  assert (L : Rabs (l3 * (inverse * DS)) <= (1 + 3 * U) * Rabs l3).
  { replace (l3 * (inverse * DS)) with (l3 * (inverse * DS - 1) + l3) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. lra. }
  replace (left * DS - l3) with ((left - l3 * inverse) * DS + l3 * (inverse * DS - 1)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. generalize (Rabs_pos l3). lra.
Qed.

(** *** Coarsely, whatever T and D: c is not much more than the test allows for *)

Lemma left_coarse : Rabs (left * DS) <= / 4194304 * S + 8589934592 * P.
Proof.
  given.
  destruct sizes as [Z1 [Z2 [Z3 [Z4 Z5]]]].
  assert (SP := S_pos). assert (G := g_pos). assert (N := eta_pos).
  assert (ED := eta_DS). assert (L := left_near). assert (NN := near_near).
  change (pow2 (-73)) with (/ 9444732965739290427392) in *.
  change (pow2 (-53)) with U in *. change (pow2 (-23)) with (/ 8388608) in *.
  set (a := 6 * w).
  assert (R1 : g * Rabs rest <= / 8388608 * (g * size_D)).
  { generalize (g_mono _ _ D_rest). lra. }
  assert (U1 : g * Rabs under <= 5 * (g * size_D)).
  { replace (5 * (g * size_D)) with (g * (5 * size_D)) by ring. apply g_mono.
    replace under with (DS + - rest) by (unfold DS; ring). eapply Rle_trans; [apply Rabs_triang|].
    rewrite Rabs_Ropp. unfold DS. generalize (Rabs_pos rest). lra. }
  assert (B0 : Rabs high <= a).
  { replace high with (TS + - low) by (unfold TS; ring). eapply Rle_trans; [apply Rabs_triang|].
    rewrite Rabs_Ropp. fold S. unfold a, w. lra. }
  assert (B1 : Rabs low <= a) by (unfold a, w; lra).
  destruct (highest_between under) as [H1 H2]. fold top in H1, H2.
  assert (A0 : 5 * (g * size_D) * (1 + / 16777216) <= a) by (unfold a, w; lra).
  assert (B2 : Rabs (near * top) <= a).
  { generalize (near_size top) (g_mono _ _ H1). lra. }
  assert (B3 : Rabs (near * (under - top)) <= a).
  { generalize (near_size (under - top)) (g_mono _ _ H2). lra. }
  assert (B4 : Rabs (near * rest) <= a) by (generalize (near_size rest); lra).
  assert (Q1 := off_any _ _ B2). fold x1 in Q1.
  assert (Q3 := off_any _ _ B4). fold x3 in Q3.
  set (h := Rabs near * eta).
  assert (H0 : 0 <= h) by (apply Rmult_le_pos; [apply Rabs_pos | lra]).
  assert (Hh : h <= 2 * (g * eta)).
  { generalize (near_size eta). rewrite Rabs_mult, (Rabs_pos_eq eta) by lra. fold h.
    assert (0 < g * eta) by now apply Rmult_lt_0_compat. lra. }
  assert (Q2 : Rabs (near * d2 - near * (under - top)) <= U * a + h).
  { replace (near * d2 - near * (under - top)) with (near * (d2 - (under - top))) by ring.
    rewrite Rabs_mult. apply Rle_trans with (Rabs near * (U * Rabs (under - top) + eta)).
    - apply Rmult_le_compat_l; [apply Rabs_pos|]. apply off_any, Rle_refl.
    - rewrite Rmult_plus_distr_l. fold h. apply Rplus_le_compat_r.
      rewrite <- Rmult_assoc, (Rmult_comm _ U), Rmult_assoc, <- Rabs_mult.
      apply Rmult_le_compat_l; [lra | exact B3]. }
  assert (B5 : Rabs (near * d2) <= 2 * a + h) by abs.
  assert (Q4 := off_any _ _ B5). fold x2 in Q4.
  assert (B6 : Rabs (high - x1) <= 3 * a + eta) by abs.
  assert (Q5 : Rabs (l1 - (high - x1)) <= U * (3 * a + eta)) by (apply off_diff; auto using rnd_float; apply rnd_float).
  assert (B7 : Rabs (l1 - x2) <= 10 * a + 10 * eta + 10 * h) by abs.
  assert (Q6 : Rabs (l2 - (l1 - x2)) <= U * (10 * a + 10 * eta + 10 * h)) by (apply off_diff; auto; apply rnd_float).
  assert (B8 : Rabs (low - x3) <= 3 * a + eta) by abs.
  assert (Q7 : Rabs (s - (low - x3)) <= U * (3 * a + eta)) by (apply off_diff; auto; apply rnd_float).
  assert (B9 : Rabs (l2 + s) <= 20 * a + 20 * eta + 20 * h) by abs.
  assert (Q8 : Rabs (l3 - (l2 + s)) <= U * (20 * a + 20 * eta + 20 * h)) by (apply off_sum; auto; apply rnd_float).
  assert (E : Rabs (l3 - (TS - near * DS)) <= 50 * U * a + 50 * eta + 50 * h).
  { clear - Q1 Q2 Q3 Q4 Q5 Q6 Q7 Q8 B9 N H0. unfold TS, DS. abs. }
  assert (E2 : Rabs l3 <= / 33554431 * S + 50 * U * a + 50 * eta + 50 * h).
  { clear - E NN SP. abs. }
  assert (E3 : 50 * U * a + 50 * eta + 50 * h <= 4294967296 * P).
  { clear - Z1 Z2 Z3 Z4 Z5 Hh SP N G. assert (0 < g * eta) by now apply Rmult_lt_0_compat.
    unfold a. unfold P in *. lra. }
  assert (PP := P_pos). clear - L ED E2 E3 SP PP. apply Rle_trans with (Rabs (left * DS - l3) + Rabs l3).
  { eapply Rle_trans; [|apply Rabs_triang]. apply Req_le. f_equal. ring. }
  lra.
Qed.

(** *** E is not less than what it stands for, and passing the test limits it *)

Lemma error_large : 1009 / 1000 * P <= error * Rabs DS /\ 0 <= error.
Proof.
  given.
  destruct sizes as [Z1 [Z2 [Z3 [Z4 Z5]]]].
  assert (SP := S_pos). assert (G := g_pos). assert (N := eta_pos). assert (PP := P_pos).
  assert (ED := eta_DS). assert (DP := DS_pos). assert (FN := first_near). assert (I := inverse_near).
  change (pow2 (-73)) with (/ 9444732965739290427392) in *. change (pow2 (-53)) with U in *.
  assert (T0 := T_least). assert (D0 := D_least). assert (T1 := pow2_pos (-1022)).
  assert (A1 : (1 - 6 * U) * (g * under_error) <= Rabs first * under_error).
  { rewrite <- Rmult_assoc. apply Rmult_le_compat_r; [lra|].
    apply Rmult_le_reg_r with (Rabs DS); [exact DP|].
    rewrite Rmult_assoc, <- S_g, <- Rabs_mult.
    replace (first * DS) with (TS - - (first * DS - TS)) by ring.
    eapply Rle_trans; [|apply Rabs_triang_inv]. rewrite Rabs_Ropp. fold S in FN |- *. lra. }
  assert (A0 : 0 <= Rabs first * under_error) by (apply Rmult_le_pos; [apply Rabs_pos | lra]).
  assert (Q1 := off_any _ _ (Req_le _ _ (Rabs_pos_eq _ A0))). fold e1 in Q1.
  assert (P1 : 0 <= e1) by now apply rnd_pos.
  assert (A2 : 0 <= e1 + high_error) by lra.
  assert (Q2 : Rabs (e2 - (e1 + high_error)) <= U * (e1 + high_error)).
  { apply off_sum; [apply rnd_float | exact F_high_error | apply Req_le, Rabs_pos_eq, A2]. }
  assert (B2 : (1 - 10 * U) * P <= e2).
  { apply Rabs_le_inv in Q1, Q2. unfold P in *.
    assert (0 < g * under_error) by (apply Rmult_lt_0_compat; lra). lra. }
  assert (A3 : 0 <= e2 * Rabs inverse).
  { apply Rmult_le_pos; [lra | apply Rabs_pos]. }
  assert (Q3 := off_any _ _ (Req_le _ _ (Rabs_pos_eq _ A3))). fold e3 in Q3.
  assert (P3 : 0 <= e3) by now apply rnd_pos.
  assert (A4 : 0 <= e3 * (4548635623644201 * pow2 (-52))).
  { apply Rmult_le_pos; [exact P3|]. generalize (pow2_pos (-52)). lra. }
  assert (Q4 := off_any _ _ (Req_le _ _ (Rabs_pos_eq _ A4))). fold error in Q4.
  split; [|now apply rnd_pos].
  change (pow2 (-52)) with (/ 4503599627370496) in *.
  assert (C3 : (1 - 3 * U) * e2 <= e2 * Rabs inverse * Rabs DS).
  { rewrite Rmult_assoc, (Rmult_comm _ e2), <- Rabs_mult. apply Rmult_le_compat_l; [lra|].
    replace (inverse * DS) with (1 - - (inverse * DS - 1)) by ring.
    eapply Rle_trans; [|apply Rabs_triang_inv]. rewrite Rabs_Ropp, Rabs_R1. lra. }
  assert (D3 : (1 - 4 * U) * e2 - eta * Rabs DS <= e3 * Rabs DS).
  { apply Rle_trans with (((1 - U) * (e2 * Rabs inverse) - eta) * Rabs DS); [lra|].
    apply Rmult_le_compat_r; [lra|]. apply Rabs_le_inv in Q3. lra. }
  assert (D4 : 4548635623644201 / 4503599627370496 * (1 - U) * (e3 * Rabs DS) - eta * Rabs DS <= error * Rabs DS).
  { rewrite <- Rmult_assoc, <- Rmult_minus_distr_r. apply Rmult_le_compat_r; [lra|].
    apply Rabs_le_inv in Q4. lra. }
  assert (S <= 2 * w) by (unfold w; lra).
  clear - D4 D3 B2 ED Z3 H PP. lra.
Qed.

(** Were E larger, c - E and c + E could not take q to the same float. *)
Lemma test_tells : error <= U * (11 / 10 * Rabs near + 3 * Rabs left + 3 * error).
Proof.
  given.
  destruct error_large as [_ E].
  assert (Fe : is_float error) by apply rnd_float.
  assert (Fn : is_float left) by apply rnd_float.
  assert (Fq : is_float near).
  { unfold near, highest. eapply generic_inclusion_mag; [|apply generic_format_round].
    - intros _. unfold fexp, FLT_exp, prec. lia.
    - apply FLT_exp_valid; reflexivity.
    - apply valid_rnd_ZR. }
  assert (B1 : Rabs (left - error) <= Rabs left + error).
  { eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, (Rabs_pos_eq error); lra. }
  assert (B2 : Rabs (left + error) <= Rabs left + error).
  { eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_pos_eq error); lra. }
  assert (Q1 := off_diff _ _ _ Fn Fe B1). fold lower in Q1.
  assert (Q2 := off_sum _ _ _ Fn Fe B2). fold upper in Q2.
  assert (B3 : Rabs (lower + near) <= Rabs near + (1 + U) * (Rabs left + error)).
  { eapply Rle_trans; [apply Rabs_triang|]. assert (Rabs lower <= (1 + U) * (Rabs left + error)); [|lra].
    replace lower with (lower - (left - error) + (left - error)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (B4 : Rabs (upper + near) <= Rabs near + (1 + U) * (Rabs left + error)).
  { eapply Rle_trans; [apply Rabs_triang|]. assert (Rabs upper <= (1 + U) * (Rabs left + error)); [|lra].
    replace upper with (upper - (left + error) + (left + error)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Q3 := off_sum lower near _ (rnd_float _) Fq B3).
  assert (Q4 := off_sum upper near _ (rnd_float _) Fq B4).
  rewrite same in Q3. assert (NP := Rabs_pos near). assert (LP := Rabs_pos left).
  clear - Q1 Q2 Q3 Q4 E NP LP. apply Rabs_le_inv in Q1, Q2, Q3, Q4. lra.
Qed.

Lemma test_limits : P <= 2 * U * S /\ error * Rabs DS <= 2 * U * S.
Proof.
  given.
  destruct error_large as [E E0]. assert (T0 := test_tells). assert (L := left_coarse).
  assert (SP := S_pos). assert (PP := P_pos). assert (DP := DS_pos).
  assert (Q : Rabs (near * DS) <= (1 + / 16777216) * S).
  { replace (near * DS) with (near * DS - TS + TS) by ring. eapply Rle_trans; [apply Rabs_triang|].
    generalize near_near. fold S. lra. }
  rewrite Rabs_mult in Q, L.
  apply (Rmult_le_compat_r (Rabs DS)) in T0; [|lra].
  clear - E E0 T0 L SP PP Q. lra.
Qed.

End Coarse.
