(** What the theorem of certificates is given does not contradict itself: every scene of finite floats
    has it. (What is found of the whole scene, as a file's answer, gets a yes.) And every square can be
    described. *)
Require Import ZArith Reals Psatz String List Bool.
From Flocq Require Import Core.
From Flocq Require BinarySingleNaN.
From Reftrace Require Import Geometry Trees Integers Clip Magnitude.
From Reftrace Require Import Contest Facts CodeAnswers CodeFloats.
From Reftrace Require Pairs Box Kept Given Leaf.
From Reftrace Require Import LeafHits LeafRight LeafYes.
Import ListNotations.
Open Scope R_scope.

Lemma power_is_fraction k : exists q, (0 < snd q)%Z /\ IZR (fst q) / IZR (snd q) = bpow radix2 k.
Proof.
  destruct (Z.le_gt_cases 0 k) as [K|K].
  - exists (2 ^ k, 1)%Z. cbn [fst snd]. split; [lia|]. rewrite (IZR_Zpower radix2) by exact K. field.
  - exists (1, 2 ^ (- k))%Z. cbn [fst snd]. assert (0 < 2 ^ (- k))%Z by (apply Z.pow_pos_nonneg; lia).
    split; [assumption|]. rewrite (IZR_Zpower radix2), bpow_opp by lia.
    generalize (bpow_gt_0 radix2 k). intros. field. lra.
Qed.
Lemma float_is_fraction x : is_float x -> exists q, is_ratio (Finite x) q.
Proof.
  intros F. destruct (power_is_fraction (exponent x - 53)) as ([n m] & P & E). cbn [fst snd] in *.
  exists (digits x * n, m)%Z. cbn [is_ratio fst snd]. split; [exact P|]. rewrite mult_IZR.
  replace (IZR (digits x) * IZR n / IZR m) with (IZR (digits x) * (IZR n / IZR m)) by (unfold Rdiv; ring).
  rewrite E. now rewrite <- digits_exact.
Qed.

(** All numbers, and 1/2: the code's power of two is theirs ([ConversionsCode.check_unit_is]). *)
Definition everything (origin direction : floats) (scene : list surface) : list R :=
  / 2 :: (components (reals origin) ++ components (reals direction)) ++ flat_map all_of scene.
Theorem given_is_possible origin direction start end_ floats_of scene :
  (forall s, In s scene -> all_finite (floats_of s) /\ shape_of s = shape_stored (floats_of s)) ->
  (forall s s', In s scene -> In s' scene -> called s = called s' -> s = s') ->
  (forall s, In s scene -> called s <> Leaf.NOWHERE) ->
  BinarySingleNaN.is_nan end_ = false -> end_ <> BinarySingleNaN.B754_infinity true ->
  less (Finite (BinarySingleNaN.B2R start)) (number_of end_) = true ->
  exists first last,
    given (Leaf.Pixel origin direction start end_ floats_of (everything origin direction scene)
      first last Given.divided) scene.
Proof.
  intros S N W A B L.
  destruct (float_is_fraction (BinarySingleNaN.B2R start) (B2R_is_float start)) as [first First].
  assert (exists last, is_ratio (number_of end_) last) as [last Last].
  { destruct (number_of end_) as [|e|] eqn:E; [now exists (-1, 0)%Z | | now exists (1, 0)%Z].
    apply number_of_float in E. destruct E as [_ <-]. apply float_is_fraction, B2R_is_float. }
  exists first, last. constructor; auto.
  - intros x X. right. apply in_or_app. now left.
  - intros s I x X. right. apply in_or_app. right. apply in_flat_map. eauto.
  - intros n d _. reflexivity.
Qed.

(** The variables of the recorded code, of whatever square and surface. *)
Open Scope string_scope.
Definition middle_float (l h : float) : float := eval (Pairs.given (Pairs.named "l" l (Pairs.named "h" h
  Pairs.nothing))) (Box.middle_code "l" "h").
Definition half_float (l h : float) : float := eval (Pairs.given (Pairs.named "l" l (Pairs.named "h" h
  Pairs.nothing))) (Box.half_code "l" "h").
Definition both (f : float -> float ->
  float) (u v : floats) := F3 (f (fx u) (fx v)) (f (fy u) (fy v)) (f (fz u) (fz v)).
Theorem can_be_described cam start q s : exists v, Kept.describes v cam start q s.
Proof.
  exists (Pairs.given (vector "eye" (Kept.eye cam) (vector "back" (Kept.back cam) (vector "low" (Kept.low q)
    (vector "high" (Kept.high q) (vector "middle" (both middle_float (Kept.low q) (Kept.high q))
    (vector "half" (both half_float (Kept.low q) (Kept.high q))
    (Pairs.named "largest" (Kept.largest q) (Pairs.named "start" start (Pairs.named "far" (Kept.far_ q)
    match s with
    | StoredTriangle a b c => vector "a" a (vector "b" b (vector "c" c Pairs.nothing))
    | StoredPlane p n => vector "a" p (vector "b" n Pairs.nothing)
    end)))))))))).
  constructor; try reflexivity; try (symmetry; apply Kept.floats_eta).
  destruct s; repeat split; try reflexivity; symmetry; apply Kept.floats_eta.
Qed.
