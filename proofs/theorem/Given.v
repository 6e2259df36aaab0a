(** What [certified] is given does not contradict itself: every scene of finite floats has it. *)
Require Import ZArith Reals List Bool.
From Flocq Require Import Core.
From Flocq Require BinarySingleNaN.
From Reftrace Require Import Geometry Trees Contest Facts.
From Reftrace Require Clip Integers.
From Reftrace Require Import CodeAnswers Certified.
Import ListNotations.
Open Scope R_scope.

(** All integers in one batch; a division that rounds once; and quotient.py, if it is never sure. *)
Definition everything (i : inputs) (scene : list surface) : batch :=
  Batch (components (reals (ray_origin i)) ++ components (first_origin i) ++ flat_map lengths_of scene)
        (components (reals (ray_direction i))).
Definition divided (n d : Z) : option R :=
  if Rlt_bool (Rabs (rnd (IZR n / IZR d))) (bpow radix2 emax) then Some (rnd (IZR n / IZR d)) else None.
Definition with_integers (i : inputs) (scene : list surface) : inputs :=
  Inputs (ray_origin i) (ray_direction i) (shared i) (clip_start i) (clip_end i) (floats_of i)
    (fun _ _ => everything i scene) (fun _ _ => everything i scene) divided (fun _ => None).

Theorem given_is_possible i scene :
  finite (ray_origin i) -> finite (ray_direction i) -> one_of_the_rays i ->
  (forall s, In s scene -> is_stored i s) ->
  (forall s s', In s scene -> In s' scene -> called s = called s' -> s = s') -> NoDup scene ->
  BinarySingleNaN.is_finite (clip_start i) = true -> BinarySingleNaN.is_nan (clip_end i) = false ->
  clip_end i <> BinarySingleNaN.B754_infinity true ->
  given (with_integers i scene) scene [scene].
Proof.
  intros O D W S N U A B C.
  assert (In_all : forall s, In s scene -> incl (lengths_of s) (lengths (everything i scene))).
  { intros s I x X. apply in_or_app. right. apply in_or_app. right. apply in_flat_map. eauto. }
  assert (Ray_in : incl (components (reals (ray_origin i))) (lengths (everything i scene))).
  { intros x X. apply in_or_app. now left. }
  assert (First_in : incl (components (first_origin i)) (lengths (everything i scene))).
  { intros x X. apply in_or_app. right. apply in_or_app. now left. }
  assert (Dir_in : in_directions (with_integers i scene) (everything i scene)) by apply incl_refl.
  constructor; auto.
  - intros s [I _]. simpl. now rewrite app_nil_r.
  - simpl. now rewrite app_nil_r.
  - simpl. rewrite app_nil_r. apply incl_refl.
  - intros s s' I I'. split; apply incl_app; auto.
  - intros s s' I I'. split; apply incl_app; auto.
  - intros s s' _ _. simpl. destruct (shared i); auto.
  - intros n d _. reflexivity.
  - intros s t' _ H. discriminate H.
Qed.
