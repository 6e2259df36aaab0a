(** Clipping by integers is exact, and t is their ratio, rounded once. Names are exact.py's. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Integers.
Import ListNotations.
Open Scope R_scope.

(** * The clip range *)

(** [IntegerBatch._limit]; None is for an infinite value, which is no limit. *)
Definition _limit (shift : Z) (value : option R) : option (Z * Z) :=
  match value with
  | None => None
  | Some value =>
      let mantissa := shifted [value] value in
      let shift := (shift - snd (integers [value]))%Z in
      Some (if (0 <=? shift)%Z then (mantissa, shift) else (Z.shiftl mantissa (- shift), 0%Z))
  end.

(** [IntegerBatch._clipped]; [side] is 1 for the start, -1 for the end. *)
Definition out_of (limit : option (Z * Z)) (side numerator denominator : Z) : bool :=
  match limit with
  | None => false
  | Some (end_, shift) =>
      (side * (Z.shiftl numerator shift - end_ * Z.abs denominator) <? 0)%Z
  end.
Definition _seen (start end_ : option (Z * Z)) (open : bool) (h : Hit) : option Hit :=
  let denominator := denominator_ h in
  if (denominator =? 0)%Z then None else
  let numerator := (if 0 <? denominator then numerator_ h else - numerator_ h)%Z in
  if ((numerator =? 0)%Z && open)%bool then None else
  if (out_of start 1 numerator denominator || out_of end_ (-1) numerator denominator)%bool
  then None else Some h.

Lemma limit_exact shift value n s numerator denominator : is_float value ->
  _limit shift (Some value) = Some (n, s) -> (0 < denominator)%Z ->
  exists k, 0 < k /\ IZR (Z.shiftl numerator s - n * denominator) =
    k * (IZR numerator / IZR denominator * bpow radix2 shift - value).
Proof.
  intros F H P. apply IZR_lt in P.
  assert (V := integers_exact [value] value (or_introl eq_refl) F).
  unfold _limit in H. set (m := shifted [value] value) in *. set (e := snd (integers [value])) in *.
  clearbody m e. injection H as H. rewrite V.
  destruct (Z.leb_spec 0 (shift - e)) as [S|S]; injection H as <- <-.
  - exists (IZR denominator * bpow radix2 (- e)).
    split; [apply Rmult_lt_0_compat; [lra | apply bpow_gt_0]|].
    rewrite Z.shiftl_mul_pow2, minus_IZR, !mult_IZR, (IZR_Zpower radix2) by lia.
    unfold Z.sub. rewrite bpow_plus, bpow_opp. generalize (bpow_gt_0 radix2 e). intros. field. lra.
  - exists (IZR denominator * bpow radix2 (- shift)).
    split; [apply Rmult_lt_0_compat; [lra | apply bpow_gt_0]|].
    rewrite Z.shiftl_0_r, Z.shiftl_mul_pow2, minus_IZR, !mult_IZR, (IZR_Zpower radix2) by lia.
    replace (- (shift - e))%Z with (e + - shift)%Z by lia.
    rewrite bpow_plus, !bpow_opp. generalize (bpow_gt_0 radix2 shift). intros. field. lra.
Qed.

(** A hit is seen where t exists and start <= t <= end, with t = T / D 2^shift exactly; but for t = 0
    where [open]. *)
Definition t_exact (shift : Z) (h : Hit) : R := ratio h * bpow radix2 shift.
Definition limit_is_float (v : option R) := match v with None => True | Some v => is_float v end.
Definition at_least (v : option R) (t : R) := match v with None => True | Some v => v <= t end.
Definition at_most (v : option R) (t : R) := match v with None => True | Some v => t <= v end.
Lemma out_exact shift value side h : (side = 1 \/ side = -1)%Z -> denominator_ h <> 0%Z ->
  limit_is_float value ->
  let numerator := (if 0 <? denominator_ h then numerator_ h else - numerator_ h)%Z in
  out_of (_limit shift value) side numerator (denominator_ h) = false <->
  match value with None => True | Some v => 0 <= IZR side * (t_exact shift h - v) end.
Proof.
  intros Hside D F numerator. destruct value as [v|]; [| simpl; tauto].
  destruct (_limit shift (Some v)) as [[n s]|] eqn:E; [| discriminate].
  assert (P : (0 < Z.abs (denominator_ h))%Z) by lia.
  destruct (limit_exact shift v n s numerator _ F E P) as (k & K & Q).
  assert (T : IZR numerator / IZR (Z.abs (denominator_ h)) = ratio h).
  { unfold numerator, ratio. apply not_0_IZR in D. destruct (Z.ltb_spec 0 (denominator_ h)).
    - now rewrite Z.abs_eq by lia.
    - rewrite Z.abs_neq, !opp_IZR by lia. field. exact D. }
  rewrite T in Q. fold (t_exact shift h) in Q. unfold out_of.
  rewrite Z.ltb_ge. set (w := (Z.shiftl numerator s - n * Z.abs (denominator_ h))%Z) in *.
  destruct Hside as [-> | ->]; split; intros H.
  - assert (0 <= IZR w) by (apply IZR_le; lia). nra.
  - assert (0 <= IZR w) by nra. apply le_IZR in H0. lia.
  - assert (IZR w <= 0) by (apply IZR_le; lia). nra.
  - assert (IZR w <= 0) by nra. apply le_IZR in H0. lia.
Qed.
Theorem seen_exact shift start end_ open h :
  limit_is_float start -> limit_is_float end_ ->
  _seen (_limit shift start) (_limit shift end_) open h = Some h <->
  denominator_ h <> 0%Z /\ (open = true -> t_exact shift h <> 0) /\
  at_least start (t_exact shift h) /\ at_most end_ (t_exact shift h).
Proof.
  intros F1 F2. unfold _seen, at_least, at_most. destruct (Z.eqb_spec (denominator_ h) 0) as [E|D].
  { split; [discriminate | tauto]. }
  assert (S1 := out_exact shift start 1 h (or_introl eq_refl) D F1).
  assert (S2 := out_exact shift end_ (-1) h (or_intror eq_refl) D F2). simpl in S1, S2.
  set (n := (if 0 <? denominator_ h then numerator_ h else - numerator_ h)%Z) in *.
  assert (Z0 : n = 0%Z <-> t_exact shift h = 0).
  { unfold t_exact, ratio. apply not_0_IZR in D. generalize (bpow_gt_0 radix2 shift). intros B.
    assert (n = 0%Z <-> numerator_ h = 0%Z) as -> by (unfold n; destruct (0 <? denominator_ h)%Z; lia).
    split; [intros ->; field; exact D|]. intros H. apply eq_IZR.
    apply Rmult_integral in H. destruct H as [H|H]; [|lra].
    apply Rmult_integral in H. destruct H as [H|H]; [exact H|].
    now apply Rinv_neq_0_compat in D. }
  destruct (Z.eqb_spec n 0) as [N|N]; simpl.
  - destruct open; simpl; [split; [discriminate | intros (_ & H & _); tauto]|].
    rewrite N in *. set (o1 := out_of _ 1 _ _) in *. set (o2 := out_of _ (-1) _ _) in *. clearbody o1 o2.
    destruct o1, o2, start, end_; simpl; (split; [try discriminate; intros _ | intros (_ & _ & A & B)]);
    try reflexivity; repeat split; try discriminate; try tauto; try (destruct S1, S2; intuition lra).
  - set (o1 := out_of _ 1 _ _) in *. set (o2 := out_of _ (-1) _ _) in *. clearbody o1 o2.
    destruct o1, o2, start, end_; simpl; (split; [try discriminate; intros _ | intros (_ & _ & A & B)]);
    try reflexivity; repeat split; try discriminate; try tauto; try (destruct S1, S2; intuition lra).
Qed.

(** * t as a float

    Python's [/] of two integers is correctly rounded: to the nearest float, ties to even, or an
    OverflowError where that is beyond the largest. This is trusted: it is CPython's [long_true_divide].
    So it is a definition of what is expected of it, and what [IntegerBatch.t] returns follows. *)
Definition true_division (division : Z -> Z -> option R) : Prop :=
  forall n d, d <> 0%Z -> division n d =
    if Rlt_bool (Rabs (rnd (IZR n / IZR d))) (bpow radix2 emax) then Some (rnd (IZR n / IZR d)) else None.
Definition t_ (division : Z -> Z -> option R) (shift : Z) (h : Hit) : option R :=
  if (0 <=? shift)%Z then division (Z.shiftl (numerator_ h) shift) (denominator_ h)
  else division (numerator_ h) (Z.shiftl (denominator_ h) (- shift)).
Theorem t_rounded division shift h : true_division division -> denominator_ h <> 0%Z ->
  t_ division shift h =
  if Rlt_bool (Rabs (rnd (t_exact shift h))) (bpow radix2 emax) then Some (rnd (t_exact shift h)) else None.
Proof.
  intros H D. unfold t_, t_exact, ratio. assert (N := not_0_IZR _ D).
  destruct (Z.leb_spec 0 shift) as [S|S]; rewrite H.
  - rewrite Z.shiftl_mul_pow2, mult_IZR, (IZR_Zpower radix2) by exact S.
    replace (_ * _ / _) with (IZR (numerator_ h) / IZR (denominator_ h) * bpow radix2 shift); [easy|]. field. exact N.
  - exact D.
  - rewrite Z.shiftl_mul_pow2, mult_IZR, (IZR_Zpower radix2) by lia.
    rewrite bpow_opp. assert (P := bpow_gt_0 radix2 shift).
    replace (_ / (_ * _)) with (IZR (numerator_ h) / IZR (denominator_ h) * bpow radix2 shift); [easy|].
    field. split; [lra | exact N].
  - rewrite Z.shiftl_mul_pow2 by lia. assert (0 < 2 ^ (- shift))%Z by (apply Z.pow_pos_nonneg; lia). nia.
Qed.
