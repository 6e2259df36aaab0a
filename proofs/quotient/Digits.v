(** How many digits numbers have, and which operations of [quotient.py] are therefore exact.

    [multiple e x]: x is a whole multiple of 2^e. Sums, differences and products of multiples are
    multiples, and one that is at most 2^53 times its 2^e is a float: no rounding changes it. From
    this: [two_sum] has no error; [halves] leaves a high half of 25 digits and the rest, without
    error; [highest] leaves 26 digits, and a rest of 27. *)
Require Import ZArith Reals Psatz Bool.
From Reftrace Require Import Trees Rounding.
From Flocq Require Import Core Plus_error Pff2Flocq.
Open Scope R_scope.

Notation pow2 := (bpow radix2).

Lemma pow2_pos e : 0 < pow2 e. Proof. apply bpow_gt_0. Qed.
Lemma pow2_le a b : (a <= b)%Z -> pow2 a <= pow2 b. Proof. apply bpow_le. Qed.
Lemma pow2_half e : pow2 (e - 1) = / 2 * pow2 e.
Proof. unfold Zminus. rewrite bpow_plus. simpl (pow2 (- (1))). lra. Qed.
Lemma float_pow2 e : (-1074 <= e)%Z -> is_float (pow2 e).
Proof. intros H. apply generic_format_FLT_bpow; [reflexivity | exact H]. Qed.

(** ** Multiples of powers of two *)

Definition multiple (e : Z) (x : R) : Prop := exists m : Z, x = IZR m * pow2 e.

Lemma multiple_opp e x : multiple e x -> multiple e (- x).
Proof. intros [m H]. exists (- m)%Z. rewrite opp_IZR, H. ring. Qed.
Lemma multiple_add e x y : multiple e x -> multiple e y -> multiple e (x + y).
Proof. intros [m H] [n K]. exists (m + n)%Z. rewrite plus_IZR, H, K. ring. Qed.
Lemma multiple_sub e x y : multiple e x -> multiple e y -> multiple e (x - y).
Proof. intros H K. apply multiple_add; [exact H | now apply multiple_opp]. Qed.
Lemma multiple_mul a b x y : multiple a x -> multiple b y -> multiple (a + b) (x * y).
Proof. intros [m H] [n K]. exists (m * n)%Z. rewrite mult_IZR, bpow_plus, H, K. ring. Qed.
Lemma multiple_le a b x : (a <= b)%Z -> multiple b x -> multiple a x.
Proof.
  intros L [m H]. exists (m * 2 ^ (b - a))%Z.
  rewrite mult_IZR. replace 2%Z with (radix_val radix2) by reflexivity. rewrite (IZR_Zpower radix2) by lia.
  rewrite Rmult_assoc, <- bpow_plus. now replace (b - a + a)%Z with b by ring.
Qed.
Lemma multiple_small e x : multiple e x -> Rabs x < pow2 e -> x = 0.
Proof.
  intros [m H] L. destruct (Z.eq_dec m 0) as [->|N]; [rewrite H; ring|]. exfalso.
  assert (1 <= Rabs (IZR m)) by (rewrite <- abs_IZR; apply IZR_le; lia).
  revert L. rewrite H, Rabs_mult, (Rabs_pos_eq (pow2 e)) by apply bpow_ge_0.
  generalize (pow2_pos e). nra.
Qed.

Theorem multiple_float e x :
  multiple e x -> Rabs x <= pow2 (e + 53) -> (-1074 <= e)%Z -> is_float x.
Proof.
  intros [m H] L E. destruct (Rle_lt_or_eq_dec _ _ L) as [S|S].
  - apply generic_format_FLT. apply (FLT_spec _ _ _ _ (Float radix2 m e)); [exact H | | exact E].
    simpl. revert S. rewrite H, Rabs_mult, (Rabs_pos_eq (pow2 e)) by apply bpow_ge_0.
    rewrite Z.add_comm, bpow_plus. intros S. apply Rmult_lt_reg_r in S; [|apply pow2_pos].
    rewrite <- abs_IZR in S. apply lt_IZR. exact S.
  - apply generic_format_abs_inv. rewrite S. apply float_pow2. lia.
Qed.

Lemma float_multiple_min x : is_float x -> multiple (-1074) x.
Proof.
  intros H. eapply multiple_le; [|eexists; exact H]. apply (Z.le_max_r (mag radix2 x - 53)).
Qed.
Lemma float_multiple e x : is_float x -> pow2 (e + 52) <= Rabs x -> multiple e x.
Proof.
  intros H L. eapply multiple_le; [|eexists; exact H].
  apply Z.le_trans with (mag radix2 x - 53)%Z; [|apply Z.le_max_l].
  assert (e + 53 <= mag radix2 x)%Z; [|lia].
  apply mag_ge_bpow. now replace (e + 53 - 1)%Z with (e + 52)%Z by ring.
Qed.

(** What is rounded is a multiple of what its size says, and off by half of that. *)
Lemma rnd_le_pow2 k x : (-1074 <= k)%Z -> Rabs x <= pow2 k -> Rabs (rnd x) <= pow2 k.
Proof. intros E H. rewrite <- rnd_abs, <- (rnd_id (pow2 k)) by now apply float_pow2. now apply rnd_le. Qed.
Lemma rnd_ge_pow2 k x : (-1074 <= k)%Z -> pow2 k <= Rabs x -> pow2 k <= Rabs (rnd x).
Proof. intros E H. rewrite <- rnd_abs, <- (rnd_id (pow2 k)) by now apply float_pow2. now apply rnd_le. Qed.
Lemma rnd_multiple e x : pow2 (e + 52) <= Rabs x -> multiple e (rnd x).
Proof.
  intros H. destruct (Z_le_gt_dec (-1074) (e + 52)) as [E|E].
  - apply float_multiple; [apply rnd_float | now apply rnd_ge_pow2].
  - apply (multiple_le _ (-1074)); [lia | apply float_multiple_min, rnd_float].
Qed.
Lemma rnd_err_abs e x : (-1074 <= e)%Z -> Rabs x <= pow2 (e + 53) -> Rabs (rnd x - x) <= pow2 (e - 1).
Proof.
  intros E H. destruct (Rle_lt_or_eq_dec _ _ H) as [S|S].
  - apply Rle_trans with (/ 2 * ulp radix2 fexp x).
    { apply error_le_half_ulp. apply fexp_valid. }
    rewrite pow2_half.
    apply Rmult_le_compat_l; [lra|].
    destruct (Req_dec x 0) as [->|N].
    + unfold fexp, prec. rewrite ulp_FLT_0 by reflexivity. now apply pow2_le.
    + rewrite ulp_neq_0 by exact N. apply pow2_le. unfold cexp, fexp, FLT_exp, prec.
      assert (mag radix2 x <= e + 53)%Z by now apply mag_le_bpow. lia.
  - rewrite rnd_id; [|apply generic_format_abs_inv; rewrite S; apply float_pow2; lia].
    rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. apply bpow_ge_0.
Qed.

(** ** Small tools: u as a number, so that linear arithmetic can do the rest *)

Notation U := (/ 9007199254740992).
Lemma u_U : u = U. Proof. rewrite u_value. reflexivity. Qed.

Lemma off_any x b : Rabs x <= b -> Rabs (rnd x - x) <= U * b + eta.
Proof. intros H. generalize (rnd_err x). rewrite u_U. lra. Qed.
Lemma off_sum x y b : is_float x -> is_float y -> Rabs (x + y) <= b ->
  Rabs (rnd (x + y) - (x + y)) <= U * b.
Proof. intros X Y H. generalize (rnd_err_sum x y X Y). rewrite u_U. lra. Qed.
Lemma off_diff x y b : is_float x -> is_float y -> Rabs (x - y) <= b ->
  Rabs (rnd (x - y) - (x - y)) <= U * b.
Proof. intros X Y H. apply off_sum; [exact X | now apply is_float_opp | exact H]. Qed.

Lemma near_1 a b x y : Rabs (a - 1) <= x -> Rabs (b - 1) <= y -> Rabs (a * b - 1) <= x + y + x * y.
Proof.
  intros A B. replace (a * b - 1) with ((a - 1) + (b - 1) + (a - 1) * (b - 1)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_mult.
  assert (Rabs (a - 1 + (b - 1)) <= x + y) by (eapply Rle_trans; [apply Rabs_triang|]; lra).
  assert (Rabs (a - 1) * Rabs (b - 1) <= x * y) by (apply Rmult_le_compat; auto using Rabs_pos).
  lra.
Qed.
Lemma ratio x y b : x <> 0 -> Rabs (y - x) <= b * Rabs x -> Rabs (y / x - 1) <= b.
Proof.
  intros N H. replace (y / x - 1) with ((y - x) * / x) by (field; exact N).
  rewrite Rabs_mult, Rabs_inv. apply Rmult_le_reg_r with (Rabs x); [now apply Rabs_pos_lt|].
  rewrite Rmult_assoc, Rinv_l, Rmult_1_r; [exact H | now apply Rabs_no_R0].
Qed.
Ltac abs := repeat match goal with H : Rabs _ <= _ |- _ => apply Rabs_le_inv in H end;
  try (apply Rabs_le); lra.

Lemma pow2_m25 : pow2 (-25) = / 33554432. Proof. reflexivity. Qed.
Lemma eta_le k x : (-1075 <= k)%Z -> pow2 k <= x -> eta <= pow2 (-1075 - k) * x.
Proof.
  intros K H. apply Rle_trans with (pow2 (-1075 - k) * pow2 k).
  - rewrite <- bpow_plus. replace (-1075 - k + k)%Z with (-1074 - 1)%Z by ring. rewrite pow2_half.
    apply Rle_refl.
  - apply Rmult_le_compat_l; [apply bpow_ge_0 | exact H].
Qed.

(** ** two_sum *)

Definition two_sum (a b : R) : R * R :=
  let total := rnd (a + b) in
  let part := rnd (total - a) in
  let rest := rnd (total - part) in
  let rest := rnd (a - rest) in
  let part := rnd (b - part) in
  (total, rnd (rest + part)).

(** Exact, however small the numbers, as long as nothing overflows (Knuth's theorem B). *)
Theorem two_sum_exact a b : is_float a -> is_float b ->
  fst (two_sum a b) + snd (two_sum a b) = a + b.
Proof.
  intros Ha Hb. apply (TwoSum_correct (-1074) prec (fun n => negb (Z.even n))); auto; try easy.
  intros x. now rewrite Z.even_opp, Z.add_1_r, Z.even_succ, <- Z.negb_even, negb_involutive.
Qed.
Theorem two_sum_rest a b : is_float a -> is_float b ->
  Rabs (snd (two_sum a b)) <= u * Rabs (a + b).
Proof.
  intros Ha Hb. generalize (two_sum_exact a b Ha Hb) (rnd_err_sum a b Ha Hb).
  change (fst (two_sum a b)) with (rnd (a + b)). intros E H.
  replace (snd (two_sum a b)) with (- (rnd (a + b) - (a + b))) by lra. now rewrite Rabs_Ropp.
Qed.
Lemma two_sum_float a b : is_float (fst (two_sum a b)) /\ is_float (snd (two_sum a b)).
Proof. split; apply rnd_float. Qed.

(** ** halves: unit is 2^k, at least the size of v; 25 digits, and the rest *)

Definition halves (v unit : R) : R * R :=
  let shift := rnd (unit * (3 * pow2 26)) in (* 1.5 * 2.0 ** (52 - BITS) *)
  let high := rnd (v + shift) in
  let high := rnd (high - shift) in
  (high, rnd (v - high)).

Theorem halves_exact k v : is_float v -> Rabs v <= pow2 k -> (-1049 <= k)%Z ->
  let (high, low) := halves v (pow2 k) in
  multiple (k - 25) high /\ Rabs high <= pow2 k /\ high + low = v /\ Rabs low <= pow2 (k - 26) /\
  is_float high /\ is_float low.
Proof.
  intros Fv V K. unfold halves.
  set (c := pow2 (k - 25)).
  assert (C : 0 < c) by apply pow2_pos.
  assert (P : forall n, (0 <= n)%Z -> pow2 (k - 25 + n) = IZR (2 ^ n) * c).
  { intros n N. rewrite Z.add_comm, bpow_plus. rewrite <- (IZR_Zpower radix2) by exact N. reflexivity. }
  assert (K0 : pow2 k = 33554432 * c) by (replace k with (k - 25 + 25)%Z at 1 by ring; now rewrite P).
  assert (Sm : multiple (k - 25) (pow2 k * (3 * pow2 26))).
  { exists (3 * 2 ^ 51)%Z. rewrite K0. fold c. rewrite mult_IZR.
    change (IZR (2 ^ 51)) with (IZR (2 ^ 25 * 2 ^ 26)). rewrite mult_IZR. simpl. lra. }
  assert (S1 : pow2 k * (3 * pow2 26) = 6755399441055744 * c) by (rewrite K0; simpl; lra).
  assert (top : pow2 (k - 25 + 53) = 9007199254740992 * c) by (rewrite P by lia; reflexivity).
  assert (bot : pow2 (k - 25 + 52) = 4503599627370496 * c) by (rewrite P by lia; reflexivity).
  rewrite (rnd_id (pow2 k * _)).
  2:{ apply (multiple_float _ _ Sm); [|lia]. rewrite top, S1, Rabs_pos_eq; lra. }
  set (s := pow2 k * (3 * pow2 26)) in *.
  assert (V' := V). apply Rabs_le_inv in V'. rewrite K0 in V'.
  set (a := rnd (v + s)).
  assert (A : multiple (k - 25) a) by (apply rnd_multiple; rewrite bot, Rabs_pos_eq; lra).
  assert (E : Rabs (a - (v + s)) <= / 2 * c).
  { unfold c. rewrite <- pow2_half. apply rnd_err_abs; [lia|]. rewrite top, Rabs_pos_eq; lra. }
  assert (B : s - 33554432 * c <= a <= s + 33554432 * c).
  { split.
    - rewrite <- (rnd_id (s - _)); [apply rnd_le; lra|].
      apply (multiple_float (k - 25)); [|rewrite top, Rabs_pos_eq; lra|lia].
      apply multiple_sub; [exact Sm|]. now exists 33554432%Z.
    - rewrite <- (rnd_id (s + _)); [apply rnd_le; lra|].
      apply (multiple_float (k - 25)); [|rewrite top, Rabs_pos_eq; lra|lia].
      apply multiple_add; [exact Sm|]. now exists 33554432%Z. }
  assert (H : multiple (k - 25) (a - s)) by now apply multiple_sub.
  assert (HB : Rabs (a - s) <= pow2 k) by (rewrite K0; apply Rabs_le; lra).
  assert (HF : is_float (a - s)).
  { apply (multiple_float _ _ H); [|lia]. eapply Rle_trans; [exact HB|]. apply pow2_le. lia. }
  rewrite (rnd_id (a - s)) by exact HF.
  assert (L : Rabs (v - (a - s)) <= pow2 (k - 26)).
  { replace (k - 26)%Z with (k - 25 - 1)%Z by ring. rewrite pow2_half. fold c.
    replace (v - (a - s)) with (- (a - (v + s))) by ring. rewrite Rabs_Ropp. lra. }
  assert (LF : is_float (v - (a - s))).
  { destruct (Rlt_or_le (Rabs v) (pow2 (k - 26))) as [T|T].
    - replace (a - s) with 0; [now rewrite Rminus_0_r|]. symmetry. apply (multiple_small _ _ H).
      replace (a - s) with (v - (v - (a - s))) by ring. eapply Rle_lt_trans; [apply Rabs_triang|].
      rewrite Rabs_Ropp. fold c. replace (pow2 (k - 26)) with (/ 2 * c) in *; [lra|].
      replace (k - 26)%Z with (k - 25 - 1)%Z by ring. rewrite pow2_half. fold c. lra.
    - set (e := Z.max (k - 78) (-1074)).
      apply (multiple_float e); [| |unfold e; lia].
      + apply multiple_sub; [|apply (multiple_le e (k - 25)); [unfold e; lia | exact H]].
        unfold e. destruct (Z.max_spec (k - 78) (-1074)) as [[_ ->]|[_ ->]].
        * now apply float_multiple_min.
        * apply float_multiple; [exact Fv|]. now replace (k - 78 + 52)%Z with (k - 26)%Z by ring.
      + eapply Rle_trans; [exact L|]. apply pow2_le. unfold e. lia. }
  rewrite (rnd_id (v - _)) by exact LF.
  repeat split; auto. ring.
Qed.

(** Three products of two such multiples, and their sums, are exact: at most 52 digits. *)
Theorem products_exact a b x y z x' y' z' :
  multiple (a - 25) x -> multiple (a - 25) y -> multiple (a - 25) z ->
  multiple (b - 25) x' -> multiple (b - 25) y' -> multiple (b - 25) z' ->
  Rabs x <= pow2 a -> Rabs y <= pow2 a -> Rabs z <= pow2 a ->
  Rabs x' <= pow2 b -> Rabs y' <= pow2 b -> Rabs z' <= pow2 b ->
  (-1024 <= a + b)%Z ->
  rnd (rnd (rnd (x * x') + rnd (y * y')) + rnd (z * z')) = x * x' + y * y' + z * z' /\
  rnd (rnd (x * x') - rnd (y * y')) = x * x' - y * y'.
Proof.
  intros X Y Z0 X' Y' Z' Xb Yb Zb Xb' Yb' Zb' E.
  assert (M : forall p q, multiple (a - 25) p -> multiple (b - 25) q -> multiple (a + b - 50) (p * q)).
  { intros p q P Q. replace (a + b - 50)%Z with (a - 25 + (b - 25))%Z by ring. now apply multiple_mul. }
  assert (S : forall p q, Rabs p <= pow2 a -> Rabs q <= pow2 b -> Rabs (p * q) <= pow2 (a + b)).
  { intros p q P Q. rewrite Rabs_mult, bpow_plus. apply Rmult_le_compat; auto using Rabs_pos. }
  assert (F : forall w, multiple (a + b - 50) w -> Rabs w <= 3 * pow2 (a + b) -> rnd w = w).
  { intros w W B. apply rnd_id. apply (multiple_float _ _ W); [|lia].
    replace (a + b - 50 + 53)%Z with (a + b + 3)%Z by ring. rewrite bpow_plus. simpl (pow2 3).
    generalize (pow2_pos (a + b)). lra. }
  assert (P := pow2_pos (a + b)).
  generalize (S _ _ Xb Xb') (S _ _ Yb Yb') (S _ _ Zb Zb'). intros S1 S2 S3.
  rewrite (F (x * x')), (F (y * y')), (F (z * z')) by (auto; lra).
  assert (M1 := M _ _ X X'). assert (M2 := M _ _ Y Y'). assert (M3 := M _ _ Z0 Z').
  apply Rabs_le_inv in S1, S2, S3. split.
  - rewrite (F (x * x' + y * y')) by (auto using multiple_add; apply Rabs_le; lra).
    apply F; [auto using multiple_add | apply Rabs_le; lra].
  - apply F; [auto using multiple_sub | apply Rabs_le; lra].
Qed.

(** ** highest: 26 digits, as bits are masked away *)

Definition highest (x : R) : R := round radix2 (FLT_exp (-1047) 26) Ztrunc x.
Lemma highest_keep v x : fl v (Keep 26 x) = highest (fl v x). Proof. reflexivity. Qed.

(** Of any number it leaves what is not larger, nor is the rest. *)
Lemma highest_between x : Rabs (highest x) <= Rabs x /\ Rabs (x - highest x) <= Rabs x.
Proof.
  assert (V : Valid_exp (FLT_exp (-1047) 26)) by (apply FLT_exp_valid; reflexivity).
  unfold highest. destruct (Rle_or_lt 0 x) as [P|P].
  - rewrite round_ZR_DN by exact P. set (h := round _ _ _ _).
    assert (0 <= h) by (apply round_ge_generic; auto using valid_rnd_DN, generic_format_0).
    assert (h <= x) by (apply round_DN_pt; exact V).
    rewrite !Rabs_pos_eq by lra. lra.
  - rewrite round_ZR_UP by lra. set (h := round _ _ _ _).
    assert (h <= 0) by (apply round_le_generic; auto using valid_rnd_UP, generic_format_0; lra).
    assert (x <= h) by (apply round_UP_pt; exact V).
    rewrite !Rabs_left1 by lra. lra.
Qed.

Theorem highest_digits x : is_float x -> pow2 (-1022) <= Rabs x ->
  exists e : Z, pow2 (e + 52) <= Rabs x < pow2 (e + 53) /\ multiple e x /\
    multiple (e + 27) (highest x) /\ Rabs (x - highest x) <= pow2 (e + 27) /\
    Rabs (highest x) <= Rabs x.
Proof.
  intros F L. exists (mag radix2 x - 53)%Z.
  assert (N : x <> 0) by (intros ->; revert L; rewrite Rabs_R0; generalize (pow2_pos (-1022)); lra).
  assert (B : pow2 (mag radix2 x - 53 + 52) <= Rabs x < pow2 (mag radix2 x - 53 + 53)).
  { replace (mag radix2 x - 53 + 52)%Z with (mag radix2 x - 1)%Z by ring.
    replace (mag radix2 x - 53 + 53)%Z with (mag radix2 x : Z) by ring.
    split; [now apply bpow_mag_le | apply bpow_mag_gt]. }
  assert (M : (-1021 <= mag radix2 x)%Z) by (apply mag_ge_bpow; exact L).
  assert (C : cexp radix2 (FLT_exp (-1047) 26) x = (mag radix2 x - 53 + 27)%Z)
    by (unfold cexp, FLT_exp; lia).
  assert (V : Valid_exp (FLT_exp (-1047) 26)) by (apply FLT_exp_valid; reflexivity).
  split; [exact B|]. split; [apply float_multiple; [exact F | apply B]|]. split; [|split].
  - exists (Ztrunc (scaled_mantissa radix2 (FLT_exp (-1047) 26) x)). unfold highest, round, F2R.
    simpl. now rewrite C.
  - rewrite <- C, <- (ulp_neq_0 radix2 (FLT_exp (-1047) 26)) by exact N.
    rewrite <- Rabs_Ropp. replace (- (x - highest x)) with (highest x - x) by ring.
    apply Rlt_le, error_lt_ulp; [exact V | apply valid_rnd_ZR | exact N].
  - apply highest_between.
Qed.

Theorem highest_near x : is_float x -> pow2 (-1022) <= Rabs x ->
  Rabs (x - highest x) <= pow2 (-25) * Rabs x.
Proof.
  intros F L. destruct (highest_digits x F L) as [e [B [_ [_ [D _]]]]].
  eapply Rle_trans; [exact D|]. replace (e + 27)%Z with (-25 + (e + 52))%Z by ring.
  rewrite bpow_plus. apply Rmult_le_compat_l; [apply bpow_ge_0 | apply B].
Qed.
