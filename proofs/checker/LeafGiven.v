(** What the theorem of certificates is given does not contradict itself: every scene of finite floats
    has it. (What is found of the whole scene, as a file's answer, gets a yes.) *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Flocq Require BinarySingleNaN.
From Reftrace Require Import Geometry Trees Integers Clip Magnitude.
From Reftrace Require Import Contest Facts CodeAnswers CodeFloats.
From Reftrace Require Given Leaf.
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
Lemma float_is_fraction x k : is_float x -> exists q, is_ratio (bpow radix2 k) (Finite x) q.
Proof.
  intros F. destruct (power_is_fraction (exponent x - 53 - k)) as ([n m] & P & E). cbn [fst snd] in *.
  exists (digits x * n, m)%Z. cbn [is_ratio fst snd]. split; [exact P|]. rewrite mult_IZR.
  replace (IZR (digits x) * IZR n / IZR m) with (IZR (digits x) * (IZR n / IZR m)) by (unfold Rdiv; ring).
  rewrite E. transitivity (IZR (digits x) * bpow radix2 (exponent x - 53)); [|now rewrite <- digits_exact].
  rewrite Rmult_assoc, <- bpow_plus. f_equal. f_equal. lia.
Qed.

Definition everything (origin direction : floats) (scene : list surface) : batch :=
  Batch (components (reals origin) ++ flat_map lengths_of scene) (components (reals direction)).
Theorem given_is_possible origin direction start end_ floats_of scene :
  (forall s, In s scene -> all_finite (floats_of s) /\ shape_of s = shape_stored (floats_of s)) ->
  (forall s s', In s scene -> In s' scene -> called s = called s' -> s = s') ->
  BinarySingleNaN.is_nan end_ = false -> end_ <> BinarySingleNaN.B754_infinity true ->
  exists first last scale,
    given (Leaf.Pixel origin direction start end_ floats_of (everything origin direction scene)
      first last scale Given.divided) scene.
Proof.
  intros S N A B. set (unit := shift_in (everything origin direction scene)).
  destruct (float_is_fraction (BinarySingleNaN.B2R start) unit (B2R_is_float start)) as [first First].
  assert (exists last, is_ratio (bpow radix2 unit) (number_of end_) last) as [last Last].
  { destruct (number_of end_) as [|e|] eqn:E; [now exists (-1, 0)%Z | | now exists (1, 0)%Z].
    apply number_of_float in E. destruct E as [_ <-]. apply float_is_fraction, B2R_is_float. }
  destruct (power_is_fraction unit) as [scale Scale].
  exists first, last, scale. constructor; auto.
  - intros s I x X. cbn [Leaf.origin Leaf.together everything lengths] in *.
    apply in_app_or in X. apply in_or_app. destruct X as [X|X]; [now left | right].
    apply in_flat_map. eauto.
  - intros x X. exact X.
  - intros n d _. reflexivity.
Qed.
