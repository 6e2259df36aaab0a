(** How floats become integers, and integers floats, as recorded: `integers.py`, the batches of `exact.py`
    and their clip limits, `_scaled` of `order.py`, and the same of the checker of certificates
    ([RecordedConversions]). What Integers.v and Clip.v say of them was written by hand from the Python;
    here a machine has compared the two. Trusted are numpy's [frexp], and Python's integers and ratios. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees Rounding Magnitude Signs Integers Clip.
From Reftrace Require Import CodeAnswers CodeOrder RecordedConversions.
Import ListNotations.
Open Scope Z_scope.

(** * [integers] *)

(** A mantissa times 2^53 is an integer that a float, and numpy's int64, has room for. *)
Theorem digits_fit x : is_float x -> Z.abs (digits x) < 2 ^ 53.
Proof.
  intros F. destruct (Req_dec x 0) as [->|N]; [unfold digits; rewrite Rmult_0_l, Ztrunc_IZR; lia|].
  apply lt_IZR. rewrite (IZR_Zpower radix2), abs_IZR by lia.
  apply (Rmult_lt_reg_r (bpow radix2 (exponent x - 53))); [apply bpow_gt_0|].
  rewrite <- (Rabs_pos_eq (bpow radix2 (exponent x - 53))) at 1 by apply bpow_ge_0.
  rewrite <- Rabs_mult, <- digits_exact, <- bpow_plus by exact F.
  replace (53 + (exponent x - 53)) with (exponent x) by lia. apply bpow_mag_gt.
Qed.
(** So the product, which is rounded, is exact, and nothing is cut off. *)
Theorem digits_is x : is_float x -> Ztrunc (rnd (mantissa x * (IZR 1 * bpow radix2 53))) = digits x.
Proof.
  intros F. replace (mantissa x * (IZR 1 * bpow radix2 53))%R with (IZR (digits x)).
  - now rewrite rnd_id, Ztrunc_IZR by now apply int_float, digits_fit.
  - unfold mantissa. rewrite (digits_exact x F) at 2.
    rewrite Rmult_assoc, Rmult_1_l, Rmult_assoc, <- !bpow_plus.
    replace (exponent x - 53 + (- exponent x + 53)) with 0 by lia. simpl. ring.
Qed.
(** Python refuses to shift by less than nothing. *)
Theorem shift_is_not_negative xs x : In x xs -> x <> 0%R -> 0 <= exponent x - least xs.
Proof.
  intros I N. enough (least xs <= exponent x) by lia. apply min_le, in_map, filter_In.
  split; [exact I|]. now rewrite Req_bool_false.
Qed.

Lemma digits_0 : digits 0 = 0.
Proof. unfold digits. now rewrite Rmult_0_l, Ztrunc_IZR. Qed.
Section Vector.
Variables x y z : R.
Hypotheses (fx : is_float x) (fy : is_float y) (fz : is_float z).
Ltac each_zero :=
  repeat match goal with |- context [Req_bool ?x 0] => destruct (Req_bool_spec x 0) as [->|] end;
  cbn [negb map min_ fold_right]; rewrite ?digits_0, ?Z.shiftl_0_l; repeat (lia || f_equal).
Theorem integers_is : let xs := [x; y; z] in
  whole_integers x y z = ([I3 (shifted xs x) (shifted xs y) (shifted xs z)], snd (integers xs)).
Proof.
  cbv zeta. unfold whole_integers, shifted, integers, least, nonzero. rewrite !digits_is by assumption.
  cbn [filter snd]. each_zero.
Qed.
(** Two vectors have one power of two. *)
Theorem integers_of_two_is : let xs := [x; y; 0; 0; 0; 0]%R in
  whole_integers_of_two x y = ([I3 (shifted xs x) 0 0; I3 (shifted xs y) 0 0], snd (integers xs)).
Proof.
  cbv zeta. unfold whole_integers_of_two, shifted, integers, least, nonzero.
  rewrite !digits_is by assumption. cbn [filter snd]. rewrite (Req_bool_true 0 0) by easy. each_zero.
Qed.
(** So each float is its integer times the power of two. *)
Corollary integers_exact : exists v unit,
  whole_integers x y z = ([v], unit) /\ V x y z = scaled unit v.
Proof. eexists _, _. split; [apply integers_is|]. apply vscale_exact; simpl; auto. Qed.

(** The checker's, where the power of two is given: those of whatever list has the three. *)
Theorem check_integers_is xs : In x xs -> In y xs -> In z xs ->
  check_integers x y z (least xs - 53) = integers_of xs (V x y z).
Proof.
  intros X Y Z. unfold check_integers, integers_of, shifted. rewrite !digits_is by assumption. cbn [vx vy vz].
  assert (S : forall t, In t xs -> t <> 0%R -> Z.max (exponent t - 53 - (least xs - 53)) 0 = exponent t - least xs).
  { intros t T N. generalize (shift_is_not_negative xs t T N). lia. }
  destruct (Req_bool_spec x 0) as [->|Nx], (Req_bool_spec y 0) as [->|Ny], (Req_bool_spec z 0) as [->|Nz];
    rewrite ?digits_0, ?Z.shiftl_0_l, ?(S x), ?(S y), ?(S z) by assumption; reflexivity.
Qed.
(** That power of two is the one of all its numbers and 1/2, which has the exponent 0. *)
Theorem check_unit_is : check_unit x y z = snd (integers [/ 2; x; y; z]%R).
Proof.
  assert (H : exponent (/ 2) = 0).
  { unfold exponent. apply mag_unique. rewrite Rabs_pos_eq by lra. simpl. lra. }
  unfold check_unit, integers, least, nonzero. cbn [snd filter]. rewrite (Req_bool_false (/ 2)) by lra.
  repeat match goal with |- context [Req_bool ?x 0] => destruct (Req_bool_spec x 0) as [->|] end;
    cbn [negb map min_ fold_right]; rewrite ?H; lia.
Qed.
End Vector.

(** * A batch: lengths share a power of two, directions another; a plane's normal has its own *)

Theorem batch_is o1 o2 d a1 a2 b1 b2 c1 c2 p n unit direction_unit start end_ :
  whole_batch o1 o2 d a1 a2 b1 b2 c1 c2 p n unit direction_unit start end_ =
  ([o1; o2], [d], [a1; a2], [b1; b2], [c1; c2], p, n, unit, shift unit direction_unit,
   start, end_, Req_bool start 0).
Proof. reflexivity. Qed.

(** * [IntegerBatch._limit] *)

(** A limit is infinite, or a float that is m / p, as [as_integer_ratio] says it: p is a power of two. *)
Definition is_ratio (limit : option R) infinite m p :=
  match limit with
  | None => infinite = true
  | Some x =>
      infinite = false /\ is_float x /\ exists k, 0 <= k /\ p = 2 ^ k /\ x = (IZR m / IZR p)%R
  end.
Lemma limit_is_exact m k shift n s numerator denominator : 0 <= k -> 0 < denominator ->
  whole_limit false m (2 ^ k) shift = Some (n, s) ->
  exists r, (0 < r /\ IZR (Z.shiftl numerator s - n * denominator) =
    r * (IZR numerator / IZR denominator * bpow radix2 shift - IZR m / IZR (2 ^ k)))%R.
Proof.
  intros K D. apply IZR_lt in D. unfold whole_limit, bit_length. change 2 with (radix_val radix2).
  rewrite Digits.Zdigits_Zpower, (IZR_Zpower radix2) by exact K.
  replace (shift + (k + 1) - 1) with (shift + k) by lia.
  assert (P := bpow_gt_0 radix2 k). assert (Q := bpow_gt_0 radix2 shift).
  destruct (Z.leb_spec 0 (shift + k)) as [S|S]; intros [= <- <-].
  - exists (bpow radix2 k * IZR denominator)%R. split; [apply Rmult_lt_0_compat; lra|].
    rewrite Z.shiftl_mul_pow2, minus_IZR, !mult_IZR, (IZR_Zpower radix2), bpow_plus by lia. field. lra.
  - exists (bpow radix2 (- shift) * IZR denominator)%R.
    split; [apply Rmult_lt_0_compat; [apply bpow_gt_0 | lra]|].
    rewrite Z.shiftl_0_r, Z.shiftl_mul_pow2, minus_IZR, !mult_IZR, (IZR_Zpower radix2) by lia.
    replace (- (shift + k)) with (- shift + - k) by lia. rewrite bpow_plus, !bpow_opp. field. lra.
Qed.
(** Clip.v has another pair of integers for it, by which the same hits are seen. *)
Theorem limit_is limit infinite m p shift side numerator denominator :
  is_ratio limit infinite m p -> 0 < denominator ->
  out_of (whole_limit infinite m p shift) side numerator denominator =
  out_of (_limit shift limit) side numerator denominator.
Proof.
  unfold is_ratio. destruct limit as [x|]; [|now intros ->]. intros (-> & F & k & K & -> & E) D.
  destruct (whole_limit false m (2 ^ k) shift) as [[n1 s1]|] eqn:L1;
    [|unfold whole_limit in L1; now destruct (0 <=? _) in L1].
  destruct (_limit shift (Some x)) as [[n2 s2]|] eqn:L2; [|discriminate].
  destruct (limit_is_exact m k shift n1 s1 numerator denominator K D L1) as (r1 & R1 & Q1).
  destruct (limit_exact shift x n2 s2 numerator denominator F L2 D) as (r2 & R2 & Q2).
  unfold out_of. rewrite Z.abs_eq by lia. rewrite <- E in Q1.
  set (t := (_ - x)%R) in *. revert Q1 Q2. generalize (Z.shiftl numerator s1 - n1 * denominator)
    (Z.shiftl numerator s2 - n2 * denominator). clearbody t. intros v w V W.
  destruct (Rtotal_order t 0) as [T|[T|T]].
  - assert (IZR v < 0 /\ IZR w < 0)%R as [A B] by nra. apply lt_IZR in A, B.
    apply eq_iff_eq_true. rewrite !Z.ltb_lt. nia.
  - subst t. rewrite Rmult_0_r in *. apply eq_IZR in V, W. now subst.
  - assert (0 < IZR v /\ 0 < IZR w)%R as [A B] by nra. apply lt_IZR in A, B.
    apply eq_iff_eq_true. rewrite !Z.ltb_lt. nia.
Qed.
Corollary seen_by_ratios_is start end_ i1 m1 p1 i2 m2 p2 shift open h :
  is_ratio start i1 m1 p1 -> is_ratio end_ i2 m2 p2 ->
  _seen (whole_limit i1 m1 p1 shift) (whole_limit i2 m2 p2 shift) open h =
  _seen (_limit shift start) (_limit shift end_) open h.
Proof.
  intros A B. unfold _seen. destruct (Z.eqb_spec (denominator_ h) 0) as [|N]; [easy|].
  assert (G : forall l i m p side n, is_ratio l i m p ->
    out_of (whole_limit i m p shift) side n (denominator_ h) =
    out_of (_limit shift l) side n (denominator_ h)).
  { intros l i m p side n H.
    assert (K := limit_is l i m p shift side n (Z.abs (denominator_ h)) H).
    unfold out_of in *. rewrite Z.abs_involutive in K. apply K. lia. }
  now rewrite (G _ _ _ _ 1 _ A), (G _ _ _ _ (-1) _ B).
Qed.

(** * [_scaled]: an integer times a power of two, at most 1, is rounded once, as Flocq's [num] is

    Python's [float] is asked of -1, 0 and 1 alone: [difference] makes the exponent so small. *)
Theorem scaled_is division to_float value shift : true_division division ->
  (forall n, (Rabs (IZR n) <= 1)%R -> to_float n = Some (IZR n)) -> bit_length value + shift <= 0 ->
  whole_scaled division to_float value shift = Some (B2R (num value shift)).
Proof.
  intros T I B. assert (S := below_1 value shift 0 B). rewrite Z.sub_0_r in S.
  rewrite num_rounded by exact S. unfold whole_scaled. destruct (Z.ltb_spec shift 0) as [N|N].
  - rewrite T by (rewrite Z.shiftl_1_l; apply Z.pow_nonzero; lia).
    rewrite Z.shiftl_1_l, (IZR_Zpower radix2) by lia.
    unfold Rdiv. rewrite <- bpow_opp, Z.opp_involutive.
    rewrite Rlt_bool_true; [easy|]. rewrite <- rnd_abs.
    apply Rle_lt_trans with (rnd 1); [now apply rnd_le|].
    rewrite rnd_id by (rewrite <- (Rmult_1_l 1); apply float_one). now apply (bpow_lt radix2 0).
  - assert (E : IZR (Z.shiftl value shift) = (IZR value * bpow radix2 shift)%R)
      by (rewrite Z.shiftl_mul_pow2, mult_IZR, (IZR_Zpower radix2) by lia; reflexivity).
    rewrite I by now rewrite E. rewrite <- E in *. rewrite <- abs_IZR in S. apply (le_IZR _ 1) in S.
    rewrite rnd_id; [easy|]. apply int_float. lia.
Qed.
