(** The theorem about certified pixels, of what the code computes.

    [code_answers] (CodeAnswers.v) is what the code computes of one ray and single surfaces: in
    binary64, by the operations that were recorded from it, and in integers. [plain] (Contest.v) is
    a model of how ladder.py and ties.py put these answers together. Here is proven that
    what [plain] says with these answers is true. What is not proven but given is in [given]. *)
Require Import ZArith Reals List Bool.
From Flocq Require Import Core.
From Flocq Require BinarySingleNaN.
From Reftrace Require Import Geometry Trees Contest Facts Nearby.
From Reftrace Require Clip Integers.
From Reftrace Require Import CodeAnswers CodeFloats CodeIntegers CodeRule CodeOrder.
Import ListNotations.
Open Scope R_scope.

Record given (i : inputs) (scene : list surface) (batches : list (list surface)) : Prop := {
  (** *** The numbers. The ray's are finite floats; so are those of each surface of the scene, and the
      surface is what these are as real numbers. Of names, no two are the same. *)
  origin_finite : finite (ray_origin i);
  direction_finite : finite (ray_direction i);
  scene_stored : forall s, In s scene -> is_stored i s;
  different_names : forall s s', In s scene -> In s' scene -> called s = called s' -> s = s';
  (** *** The clip range. Its start is a finite float; its end is one, or infinity. *)
  start_finite : BinarySingleNaN.is_finite (clip_start i) = true;
  end_not_nan : BinarySingleNaN.is_nan (clip_end i) = false;
  end_not_minus : clip_end i <> BinarySingleNaN.B754_infinity true;
  (** *** What rays share: this one is among those that bounds were computed for. Of the rays of a
      camera that is proven, but for panoramas: CameraRays.v. *)
  among_the_rays : one_of_the_rays i;
  (** *** What is proposed: all surfaces that are met, none twice. That candidates.py does so is argued
      by hand. *)
  all_proposed : forall s, met (stored_ray i) (start i) (end_ i) scene s -> In s (concat batches);
  none_twice : NoDup (concat batches);
  none_else : incl (concat batches) scene;
  (** *** Integers. A batch has the numbers of those that it is asked of: which others are in it does
      not matter. *)
  settled_lengths : forall s s', In s scene -> In s' scene ->
    in_lengths (settled_in i s s') (reals (ray_origin i)) s /\
    in_lengths (settled_in i s s') (reals (ray_origin i)) s';
  settled_directions : forall s s', In s scene -> In s' scene -> in_directions i (settled_in i s s');
  ordered_lengths : forall s s', In s scene -> In s' scene ->
    in_lengths (ordered_in i s s') (first_origin i) s /\ in_lengths (ordered_in i s s') (first_origin i) s';
  ordered_directions : forall s s', In s scene -> In s' scene ->
    match shared i with ParallelRays _ _ _ => in_directions i (ordered_in i s s') | _ => True end;
  (** *** Division. Python's [/] of two integers is rounded once; and so is t of quotient.py, where
      that says that it is sure (Quotient.v). *)
  division_rounds_once : Clip.true_division (division i);
  quotient_rounds_once : forall s t', met (stored_ray i) (start i) (end_ i) scene s ->
    quotient i s = Some t' -> t' = nearest_float (t (stored_ray i) s)
}.

Section Certified.
Context {i : inputs} {scene : list surface} {batches : list (list surface)}.
Hypothesis G : given i scene batches.
Notation r := (stored_ray i).
Notation met := (met r (start i) (end_ i) scene).

Lemma end_known : number_of (clip_end i) <> MinusInfinity.
Proof.
  generalize (end_not_nan _ _ _ G) (end_not_minus _ _ _ G).
  destruct (clip_end i) as [|[]| |]; simpl; intros; congruence.
Qed.

Lemma hit_of s : In s scene -> ((exists h, code_hit i (alone i s) s = Some h) <-> met s).
Proof.
  intros I. rewrite (code_hit_met i _ (settled_directions _ _ _ G s s I I) end_known s
    (proj1 (settled_lengths _ _ _ G s s I I)) (scene_stored _ _ _ G s I)).
  unfold Facts.met. tauto.
Qed.
Lemma met_hit s : met s -> exists h, code_hit i (alone i s) s = Some h.
Proof. intros M. apply hit_of; [apply M | exact M]. Qed.
Lemma both_hit s s' : met s -> met s' ->
  (exists h, code_hit i (settled_in i s s') s = Some h) /\
  (exists h, code_hit i (settled_in i s s') s' = Some h).
Proof.
  intros M M'. assert (I := proj1 M). assert (I' := proj1 M').
  destruct (settled_lengths _ _ _ G s s' I I') as [L L'].
  assert (Dir := settled_directions _ _ _ G s s' I I').
  split.
  - apply (code_hit_met i _ Dir end_known s L (scene_stored _ _ _ G s I)). split; apply M.
  - apply (code_hit_met i _ Dir end_known s' L' (scene_stored _ _ _ G s' I')). split; apply M'.
Qed.

(** ** Every fact that the theorem of [plain] rests on holds of the code's answers *)

Theorem code_ray_facts : ray_facts r (start i) (end_ i) scene batches (code_answers i).
Proof.
  assert (Of := origin_finite _ _ _ G). assert (Df := direction_finite _ _ _ G).
  assert (One := among_the_rays _ _ _ G). assert (St := scene_stored _ _ _ G).
  constructor.
  - exact (different_names _ _ _ G).
  - assert (E := end_known). unfold end_ in *.
    destruct (number_of (clip_end i)) as [|e|] eqn:H; auto.
    apply number_of_float in H. destruct H as [F <-]. now exists (clip_end i).
  - exact (all_proposed _ _ _ G).
  - exact (none_twice _ _ _ G).
  - exact (none_else _ _ _ G).
  - intros s I. apply code_impossible; auto.
  - intros s I. apply code_surely; auto.
  - intros s h I. apply code_interval_above; auto.
  - intros s I. apply code_interval_not_minus; auto.
  - intros s I. apply code_interval_below; auto.
  - intros A s s' I I'. destruct (ordered_lengths _ _ _ G s s' I I') as [L L'].
    apply code_order_right; auto. exact (ordered_directions _ _ _ G s s' I I').
  - intros s I. simpl. unfold asked. rewrite <- (hit_of s I).
    destruct (code_hit i (alone i s) s) as [h|]; split; eauto; try discriminate. now intros [h H].
  - intros s M. simpl. unfold asked. destruct (met_hit s M) as [h H]. rewrite H.
    assert (I := proj1 M). apply (code_hit_facts i _ (settled_directions _ _ _ G s s I I) end_known s
      (proj1 (settled_lengths _ _ _ G s s I I)) (St s I) h H).
  - intros s s' M M'. simpl. unfold compared. assert (I := proj1 M). assert (I' := proj1 M').
    destruct (both_hit s s' M M') as [[h H] [h' H']]. rewrite H, H'.
    destruct (settled_lengths _ _ _ G s s' I I') as [L L'].
    apply (code_gap_right i _ (settled_directions _ _ _ G s s' I I') end_known s s'); auto.
  - intros s M. simpl. destruct (quotient i s) as [t'|] eqn:Q.
    + now apply (quotient_rounds_once _ _ _ G).
    + unfold asked. destruct (met_hit s M) as [h H]. rewrite H. assert (I := proj1 M).
      apply (integer_t_right i _ (settled_directions _ _ _ G s s I I) end_known s
        (proj1 (settled_lengths _ _ _ G s s I I)) (St s I)); auto.
      exact (division_rounds_once _ _ _ G).
Qed.

Theorem code_rule_facts :
  @rule_facts_nearby _ soon (moved_ray r) r (start i) (end_ i) scene (code_answers i).
Proof.
  assert (St := scene_stored _ _ _ G). constructor.
  - intros s M. simpl. unfold asked. destruct (met_hit s M) as [h H]. rewrite H. assert (I := proj1 M).
    apply (code_is_crossed_right i _ (settled_directions _ _ _ G s s I I) end_known s h
      (proj1 (settled_lengths _ _ _ G s s I I))); auto.
  - intros s s' M M'. simpl. unfold compared. assert (I := proj1 M). assert (I' := proj1 M').
    destruct (both_hit s s' M M') as [[h H] [h' H']]. rewrite H, H'.
    destruct (settled_lengths _ _ _ G s s' I I') as [L L'].
    refine (weaker _ soon_filter _ _ _ (code_sign_right i _ (settled_directions _ _ _ G s s' I I')
      end_known s s' h h' L L' (St s I) (St s' I') H H')).
    intros by_ K _ _. exact K.
Qed.

(** * The theorem

    [r] is the stored ray. [moved_ray r (x, y)] is one beside it: its direction is d + (x, x^2, x^3),
    and its origin o + (y, y^2, y^3); [soon]: for all x > 0 that are small enough, and then all
    y > 0 that are. A ray meets a surface where its line passes through the triangle, or the infinite
    plane, at a t = T / D within the clip range. ([met], [moved_sees] and [clearly_sees] are a few
    lines each, in Facts.v.) *)
Theorem certified :
  let result := plain (code_answers i) (start i) (end_ i) batches in
  (* The pixel's owner is the nearest of all surfaces that the moved ray meets, by name where
     several lie in one plane; and nothing, if it meets nothing. *)
  soon (fun by_ => moved_sees r (moved_ray r by_) (start i) (end_ i) scene (owner result)) /\
  match certain result with
  (* Where the pixel is called BOUND or EXACT, the stored ray itself meets the owner at no edge, and
     all else that it meets is strictly farther; or it meets nothing. *)
  | BOUND | EXACT => clearly_sees r (start i) (end_ i) scene (owner result)
  (* Where it is called AMBIGUOUS, no surface, nor nothing, is that. *)
  | AMBIGUOUS => forall answer, ~ clearly_sees r (start i) (end_ i) scene answer
  end /\
  (* t of the owner is T / D of the stored ray in exact arithmetic, rounded once: the nearest
     float64, of two the even one. *)
  t_of_owner result =
    match owner result with Some s => Some (nearest_float (T r s / D r s)) | None => None end.
Proof.
  exact (plain_is_right_by_the_rule r (start i) (end_ i) scene batches (code_answers i)
    code_ray_facts code_rule_facts).
Qed.
End Certified.
