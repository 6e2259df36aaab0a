(** The quotient t = T / D of [quotient.py], finely: what passes Ziv's test is rnd (T / D).

    Passed, the test has shown that T and D are known well ([Division.v]): the products of q are
    exact, so is the first difference (Sterbenz), and c is off by so little that E covers it. *)
Require Import ZArith Reals Psatz Bool.
From Reftrace Require Import Trees Rounding Digits Division.
From Flocq Require Import Core Sterbenz.
Open Scope R_scope.

Section Fine.
Context {c : case} {p : passes c}.

(** *** Finely: T and D are known so well that products of q are exact *)

Lemma well_known : w <= 2097152 * S /\ Rabs low + g * Rabs rest <= / 8388608 * w /\
  pow2 (-970) <= S /\ pow2 (-970) <= Rabs DS /\ under_error <= 2 * U * Rabs DS.
Proof.
  given.
  destruct test_limits as [L _]. destruct sizes as [_ [_ [Z3 _]]].
  assert (G := g_pos). assert (T0 := T_least). assert (D0 := D_least). assert (B := pow2_pos (-1022)).
  change (pow2 (-73)) with (/ 9444732965739290427392) in *. change (pow2 (-23)) with (/ 8388608) in *.
  assert (C : pow2 (-970) * (2 * U) = pow2 (-1022)).
  { replace (2 * U) with (pow2 (-52)) by (simpl; lra). now rewrite <- bpow_plus. }
  assert (E1 : under_error <= 2 * U * Rabs DS).
  { apply Rmult_le_reg_l with g; [exact G|].
    replace (g * (2 * U * Rabs DS)) with (2 * U * S) by (rewrite S_g; ring). unfold P in L. lra. }
  assert (E2 : high_error <= 2 * U * S).
  { unfold P in L. assert (0 < g * under_error) by (apply Rmult_lt_0_compat; lra). lra. }
  repeat split; try lra.
  unfold w. generalize (g_mono _ _ D_rest). lra.
Qed.

Lemma under_large : 3 / 4 * Rabs DS <= Rabs under /\ pow2 (-1022) <= Rabs under /\
  g * Rabs under <= 5 / 4 * S.
Proof.
  given.
  destruct well_known as [W [R [_ [B _]]]]. assert (G := g_pos).
  assert (H : Rabs rest <= / 4 * Rabs DS).
  { apply Rmult_le_reg_l with g; [exact G|].
    replace (g * (/ 4 * Rabs DS)) with (/ 4 * S) by (rewrite S_g; ring).
    generalize (Rabs_pos low). lra. }
  assert (L : 3 / 4 * Rabs DS <= Rabs under).
  { replace under with (DS - rest) by (unfold DS; ring). eapply Rle_trans; [|apply Rabs_triang_inv]. lra. }
  assert (K : Rabs under <= 5 / 4 * Rabs DS).
  { replace under with (DS + - rest) by (unfold DS; ring). eapply Rle_trans; [apply Rabs_triang|].
    rewrite Rabs_Ropp. lra. }
  repeat split; [exact L| |].
  - assert (pow2 (-1022) <= pow2 (-971)) by (apply pow2_le; lia).
    assert (pow2 (-971) = / 2 * pow2 (-970)) by apply (pow2_half (-970)).
    generalize DS_pos. lra.
  - apply g_mono in K. rewrite S_g. lra.
Qed.

Lemma products_of_near : is_float (near * top) /\ is_float (near * (under - top)) /\
  is_float (under - top).
Proof.
  given.
  destruct under_large as [L [M _]]. destruct well_known as [_ [_ [B _]]].
  destruct (highest_digits first (rnd_float _) first_large) as [a [[_ A1] [_ [A2 [_ A3]]]]].
  destruct (highest_digits under F_under M) as [b [[_ B1] [B2 [B3 [B4 B5]]]]].
  fold near in A2, A3. fold top in B3, B4, B5.
  assert (E : (-971 < a + b + 106)%Z).
  { apply (lt_bpow radix2). apply Rle_lt_trans with (Rabs first * Rabs under).
    - apply Rle_trans with (3 / 4 * (Rabs first * Rabs DS)).
      + rewrite <- Rabs_mult. replace (first * DS) with (TS - - (first * DS - TS)) by ring.
        apply Rle_trans with (3 / 4 * ((1 - 6 * U) * S)).
        * change (-971)%Z with (-970 - 1)%Z. rewrite pow2_half. generalize S_pos. lra.
        * apply Rmult_le_compat_l; [lra|]. eapply Rle_trans; [|apply Rabs_triang_inv].
          rewrite Rabs_Ropp. generalize first_near. fold S. lra.
      + generalize (Rmult_le_compat_l _ _ _ (Rabs_pos first) L). lra.
    - replace (a + b + 106)%Z with (a + 53 + (b + 53))%Z by ring. rewrite bpow_plus.
      apply Rmult_le_0_lt_compat; auto using Rabs_pos. }
  assert (bound : forall x y m n, Rabs x <= pow2 m -> Rabs y <= pow2 n -> Rabs (x * y) <= pow2 (m + n)).
  { intros x y m n X Y. rewrite Rabs_mult, bpow_plus. apply Rmult_le_compat; auto using Rabs_pos. }
  assert (N : Rabs near <= pow2 (a + 53)) by lra.
  assert (R : multiple b (under - top)).
  { apply multiple_sub; [exact B2|]. apply (multiple_le _ (b + 27)); [lia | exact B3]. }
  repeat split.
  - apply (multiple_float _ _ (multiple_mul _ _ _ _ A2 B3)); [|lia].
    replace (a + 27 + (b + 27) + 53)%Z with (a + 53 + (b + 54))%Z by ring. apply bound; [exact N|].
    eapply Rle_trans; [exact B5|]. apply Rlt_le. eapply Rlt_le_trans; [exact B1|]. apply pow2_le. lia.
  - apply (multiple_float _ _ (multiple_mul _ _ _ _ A2 R)); [|lia].
    replace (a + 27 + b + 53)%Z with (a + 53 + (b + 27))%Z by ring. now apply bound.
  - replace (under - top) with (under + - top) by ring.
    apply (multiple_float (Z.max b (-1074))); [| |lia].
    + destruct (Z.max_spec b (-1074)) as [[H ->]|[_ ->]]; [|exact R].
      apply multiple_sub; [now apply float_multiple_min|].
      apply float_multiple_min. unfold top, highest.
      eapply generic_inclusion_mag; [|apply generic_format_round].
      * intros _. unfold fexp, FLT_exp, prec. lia.
      * apply FLT_exp_valid; reflexivity.
      * apply valid_rnd_ZR.
    + eapply Rle_trans; [exact B4|]. apply pow2_le. lia.
Qed.

(** The first difference is exact: Sterbenz. *)
Lemma first_difference : l1 = high - near * top.
Proof.
  given.
  destruct products_of_near as [H _]. destruct well_known as [W [R _]].
  destruct under_large as [_ [M V]].
  assert (X : x1 = near * top) by now apply rnd_id.
  unfold l1. rewrite X. apply rnd_id.
  apply generic_format_plus_weak; [apply fexp_valid | apply FLT_exp_monotone | exact F_high | now apply is_float_opp |].
  fold (high - near * top). rewrite Rabs_Ropp.
  assert (N := near_near). assert (SP := S_pos). assert (G := g_pos).
  assert (Q1 := near_size rest). assert (Q2 := near_size (under - top)).
  assert (Q3 := highest_near under F_under M). fold top in Q3. rewrite pow2_m25 in Q3.
  apply g_mono in Q3.
  assert (RP : 0 <= g * Rabs rest) by (apply Rmult_le_pos; [lra | apply Rabs_pos]).
  assert (A : Rabs (high - near * top) <= 3 / 10 * S).
  { replace (high - near * top) with (- (near * DS - TS) + - low + near * rest + near * (under - top))
      by (unfold DS, TS; ring).
    eapply Rle_trans; [apply Rabs_triang|]. eapply Rle_trans; [apply Rplus_le_compat_r, Rabs_triang|].
    eapply Rle_trans; [apply Rplus_le_compat_r, Rplus_le_compat_r, Rabs_triang|].
    rewrite !Rabs_Ropp. generalize (Rabs_pos low). lra. }
  assert (B : 3 / 4 * S <= Rabs high).
  { replace high with (TS - low) by (unfold TS; ring). eapply Rle_trans; [|apply Rabs_triang_inv].
    fold S. lra. }
  assert (C : 4 / 10 * S <= Rabs (near * top)).
  { replace (near * top) with (high - (high - near * top)) by ring.
    eapply Rle_trans; [|apply Rabs_triang_inv]. lra. }
  apply Rmin_glb; lra.
Qed.

(** What is computed of T - q D is off by few roundings of what is small. *)
Lemma l3_fine : Rabs (l3 - (TS - near * DS)) <=
  U * (21 / 10 * (/ 33554432 + 8 * U) * S + 7 / 2 * (Rabs low + g * Rabs rest)) + 4 * eta.
Proof.
  given.
  destruct products_of_near as [_ [H D2]]. destruct well_known as [W [R _]].
  assert (X : x2 = near * (under - top)).
  { unfold x2, d2. rewrite (rnd_id (under - top)) by exact D2. now apply rnd_id. }
  assert (N := near_near). assert (SP := S_pos). assert (G := g_pos). assert (E := eta_pos).
  set (k := / 33554432 + 8 * U) in *. set (y := g * Rabs rest) in *. set (z := Rabs low) in *.
  assert (Y0 : 0 <= y) by (apply Rmult_le_pos; [lra | apply Rabs_pos]).
  assert (Z0 : 0 <= z) by apply Rabs_pos.
  assert (Q1 := near_size rest). fold y in Q1.
  assert (Q2 := off_any _ _ Q1). fold x3 in Q2.
  assert (LZ : Rabs low <= z) by apply Rle_refl.
  assert (B2 : Rabs (l1 - x2) <= k * S + z + (1 + / 16777216) * y).
  { rewrite first_difference, X. clear - N Q1 LZ. unfold DS, TS in N. abs. }
  assert (Q3 : Rabs (l2 - (l1 - x2)) <= U * (k * S + z + (1 + / 16777216) * y))
    by (apply off_diff; auto; apply rnd_float).
  assert (B3 : Rabs (low - x3) <= z + (1 + / 8388608) * y + eta) by (clear - Q1 Q2 LZ Y0; abs).
  assert (Q4 : Rabs (s - (low - x3)) <= U * (z + (1 + / 8388608) * y + eta))
    by (apply off_diff; auto; apply rnd_float).
  assert (Q : Rabs (l2 + s - (TS - near * DS)) <= U * (k * S + 2 * z + (3 + / 1048576) * y) + 2 * eta).
  { rewrite first_difference, X in Q3. clear - Q2 Q3 Q4 E Y0. unfold DS, TS. abs. }
  assert (K0 : 0 < k * S) by (apply Rmult_lt_0_compat; unfold k; lra).
  assert (B5 : Rabs (l2 + s) <= (1 + U) * (k * S) + 3 * U * z + 4 * U * y + 2 * eta).
  { clear - Q N Y0 Z0 E. abs. }
  assert (Q5 : Rabs (l3 - (l2 + s)) <= U * ((1 + U) * (k * S) + 3 * U * z + 4 * U * y + 2 * eta))
    by (apply off_sum; auto; apply rnd_float).
  clear - Q Q5 Y0 Z0 E K0. abs.
Qed.

(** *** t itself *)

Lemma D_not_0 : (1 - 2 * U) * Rabs DS <= Rabs D /\ D <> 0.
Proof.
  given.
  destruct well_known as [W [_ [_ [_ H]]]]. assert (G := g_pos). assert (SP := S_pos).
  destruct sizes as [Z1 [Z2 _]].
  assert (ZD : 0 <= size_D).
  { apply Rmult_le_reg_l with g; lra. }
  assert (A : Rabs (D - DS) <= 2 * U * Rabs DS).
  { revert D_error. fold DS. generalize (pow2_pos (-73)). nra. }
  assert (B : (1 - 2 * U) * Rabs DS <= Rabs D).
  { replace D with (DS - - (D - DS)) by ring. eapply Rle_trans; [|apply Rabs_triang_inv].
    rewrite Rabs_Ropp. lra. }
  split; [exact B|]. intros Z. revert B. rewrite Z, Rabs_R0. generalize DS_pos. lra.
Qed.

Lemma t_near : Rabs (T / D * DS - TS) <= (1 + 4 * U) * (P - pow2 (-73) * w).
Proof.
  given.
  destruct D_not_0 as [B N]. assert (M := DS_not_0). assert (G := g_pos). assert (DP := DS_pos).
  replace (T / D * DS - TS) with (DS / D * ((T - TS) - TS / DS * (D - DS))) by (field; auto).
  rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos.
  - unfold Rdiv. rewrite Rabs_mult, Rabs_inv.
    assert (0 < Rabs D) by now apply Rabs_pos_lt.
    apply Rmult_le_reg_r with (Rabs D); [assumption|].
    rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. lra.
  - eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, Rabs_mult.
    replace (Rabs (TS / DS)) with g.
    2:{ unfold g, S, Rdiv. now rewrite Rabs_mult, Rabs_inv. }
    assert (H : Rabs (D - DS) <= under_error - pow2 (-73) * size_D) by (unfold DS; lra).
    apply g_mono in H. unfold P, w. unfold TS at 1. lra.
Qed.

(** c - E and c + E, rounded, enclose t - q. *)
Lemma enclosed : lower <= T / D - near <= upper.
Proof.
  given.
  destruct error_large as [E E0]. destruct test_limits as [L1 L2]. destruct sizes as [Z1 [Z2 [Z3 [Z4 Z5]]]].
  destruct well_known as [W [R _]].
  assert (SP := S_pos). assert (PP := P_pos). assert (DP := DS_pos). assert (N := eta_pos).
  assert (T1 := t_near). assert (LN := left_near). assert (LF := l3_fine). assert (ED := eta_DS).
  assert (NN := near_near). assert (G := g_pos).
  change (pow2 (-73)) with (/ 9444732965739290427392) in *. change (pow2 (-53)) with U in *.
  assert (SW : S <= 2 * w) by (unfold w; lra).
  assert (EP : eta <= U * P).
  { unfold P. assert (0 < g * under_error); [|lra]. apply Rmult_lt_0_compat; [exact G|].
    eapply Rlt_le_trans; [apply (pow2_pos (-1022)) | exact D_least]. }
  set (k := / 33554432 + 8 * U) in *.
  set (b := Rabs low + g * Rabs rest) in *.
  assert (K0 : k * S <= / 33554431 * S) by (apply Rmult_le_compat_r; unfold k; lra).
  assert (KP : 0 < k * S) by (apply Rmult_lt_0_compat; unfold k; lra).
  assert (LB : Rabs l3 <= 101 / 100 * (k * S) + 4 * U * b + 4 * eta).
  { replace l3 with (l3 - (TS - near * DS) + - (near * DS - TS)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
    assert (0 <= b) by (apply Rplus_le_le_0_compat; [apply Rabs_pos | apply Rmult_le_pos; [lra | apply Rabs_pos]]).
    lra. }
  assert (LD : Rabs left * Rabs DS <= 101 / 100 * Rabs l3 + eta * Rabs DS).
  { rewrite <- Rabs_mult. replace (left * DS) with (left * DS - l3 + l3) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. generalize (Rabs_pos l3). lra. }
  assert (C : Rabs (left - (T / D - near)) * Rabs DS <=
    5 * U * Rabs l3 + eta * Rabs DS + (U * (21 / 10 * k * S + 7 / 2 * b) + 4 * eta)
      + (1 + 4 * U) * (P - / 9444732965739290427392 * w)).
  { rewrite <- Rabs_mult.
    replace ((left - (T / D - near)) * DS)
      with ((left * DS - l3) + (l3 - (TS - near * DS)) + - (T / D * DS - TS)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
    eapply Rle_trans; [apply Rplus_le_compat_r, Rabs_triang|]. lra. }
  assert (M : Rabs (left - (T / D - near)) + U * (Rabs left + error) <= error).
  { apply Rmult_le_reg_r with (Rabs DS); [exact DP|].
    clear - C LD LB K0 KP EP SW R ED E Z3 PP SP N. lra. }
  assert (B1 : Rabs (left - error) <= Rabs left + error).
  { eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, (Rabs_pos_eq error); lra. }
  assert (B2 : Rabs (left + error) <= Rabs left + error).
  { eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_pos_eq error); lra. }
  assert (Q1 := off_diff left error _ (rnd_float _) (rnd_float _) B1). fold lower in Q1.
  assert (Q2 := off_sum left error _ (rnd_float _) (rnd_float _) B2). fold upper in Q2.
  assert (M' : Rabs (left - (T / D - near)) <= error - U * (Rabs left + error)) by lra.
  clear - Q1 Q2 M'. apply Rabs_le_inv in Q1, Q2, M'. lra.
Qed.

Theorem ziv : D <> 0 /\ rnd (upper + near) = rnd (T / D).
Proof.
  given.
  split; [apply D_not_0|]. destruct enclosed as [A B]. apply Rle_antisym.
  - rewrite <- same. apply rnd_le. lra.
  - apply rnd_le. lra.
Qed.
End Fine.

(** The code, operation by operation. An e of inf is not modelled: see [Overflow.v]. *)
Definition quotient (high low high_error under rest under_error : R) : R * bool :=
  let inverse := rnd (under + rest) in
  let inverse := rnd (1 / inverse) in
  let first := rnd (high + low) in
  let first := rnd (first * inverse) in
  let near := highest first in
  let top := highest under in
  let left := rnd (high - rnd (near * top)) in
  let left := rnd (left - rnd (near * rnd (under - top))) in
  let left := rnd (left + rnd (low - rnd (near * rest))) in
  let left := rnd (left * inverse) in
  let size := Rabs first in
  let error := rnd (size * under_error) in
  let error := rnd (error + high_error) in
  let error := rnd (error * Rabs inverse) in
  let error := rnd (error * (4548635623644201 * pow2 (-52))) in (* _LOOSE: 1.01, as a float *)
  let least := rnd (left - error) in
  let least := rnd (least + near) in
  let left := rnd (left + error) in
  let left := rnd (left + near) in
  (left, Req_bool least left && Rlt_bool (pow2 (-950)) size).

(** Where the second result of [_quotient] is True, the first is the float nearest to T / D. *)
Theorem quotient_correct T D high low high_error under rest under_error size_T size_D :
  is_float high -> is_float low -> is_float high_error ->
  is_float under -> is_float rest -> is_float under_error ->
  Rabs (T - (high + low)) + pow2 (-73) * size_T <= high_error ->
  Rabs (D - (under + rest)) + pow2 (-73) * size_D <= under_error ->
  Rabs low <= pow2 (-23) * size_T -> Rabs rest <= pow2 (-23) * size_D ->
  Rabs (high + low) <= 4 * size_T -> Rabs (under + rest) <= 4 * size_D ->
  pow2 (-1022) <= high_error -> pow2 (-1022) <= under_error -> size_D <= pow2 1001 ->
  snd (quotient high low high_error under rest under_error) = true ->
  D <> 0 /\ fst (quotient high low high_error under rest under_error) = rnd (T / D).
Proof.
  intros. match goal with H : snd _ = true |- _ => apply andb_prop in H; destruct H as [same size] end.
  revert same; case Req_bool_spec; [intros same _ | discriminate].
  revert size; case Rlt_bool_spec; [intros size _ | discriminate].
  set (c := Case T D high low high_error under rest under_error size_T size_D
    ltac:(assumption) ltac:(assumption) ltac:(assumption) ltac:(assumption) ltac:(assumption)
    ltac:(assumption) ltac:(assumption) ltac:(assumption) ltac:(assumption) ltac:(assumption)
    ltac:(assumption) ltac:(assumption) ltac:(assumption) ltac:(assumption) ltac:(assumption)).
  exact (@ziv c (Passes c size same)).
Qed.
