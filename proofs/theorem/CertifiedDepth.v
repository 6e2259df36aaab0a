(** The theorem about certified pixels, with t as quotient.py divides.

    [certified] is given that t is T / D, rounded once, wherever quotient.py is sure. Here that is
    proven, of what was recorded of quotient.py and evaluated in binary64: so it is no longer given,
    but for two things that are said in [given_but_depth]. *)
Require Import ZArith Reals Psatz List Bool String.
From Flocq Require Import Core.
From Flocq Require BinarySingleNaN.
From Reftrace Require Rounding QuotientWhole QuotientBinary RecordedQuotient.
From Reftrace Require Import Geometry Trees Contest Facts Nearby.
From Reftrace Require Clip Integers.
From Reftrace Require Import CodeAnswers Certified Given.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.

(** ** What was recorded, of one ray and one surface *)

(** A surface's plane is prepared for many rays: they share an origin; or a direction; or nothing.
    [most] is by component the largest size that a ray's direction has; of parallel rays, the largest
    distance of an origin from the [first], as computed. *)
Inductive preparation :=
| ForOneOrigin (most : floats)
| ForOneDirection (first most : floats)
| ForAnyRays.

Definition triple (v : floats) : QuotientBinary.fvec := QuotientBinary.FVec (fx v) (fy v) (fz v).
Definition prepared_surface (s : stored) : QuotientBinary.fsurface :=
  match s with
  | StoredTriangle a b c => QuotientBinary.FCorners (triple a) (triple b) (triple c)
  | StoredPlane p n => QuotientBinary.FPlane (triple p) (triple n)
  end.

(** The power of two above [most], as computed. *)
Definition unit_of_directions (most : floats) : float :=
  eval (QuotientBinary.fstage (QuotientBinary.fxyz "d" (triple most)))
    RecordedQuotient.unit_from_point.
Definition unit_of_origins (most : floats) : float :=
  eval (QuotientBinary.fstage (QuotientBinary.fxyz "v" (triple most)))
    RecordedQuotient.power_above.

Section Recorded.
Variable i : inputs.
Variable p : preparation.
Notation o := (ray_origin i).
Notation d := (ray_direction i).

(** [_quotient]'s arguments, as the recorded [_enter] and [meet] compute them. *)
Definition arguments (s : surface) : env :=
  let plane := prepared_surface (floats_of i s) in
  match p with
  | ForOneOrigin most => QuotientBinary.fmet_from_point plane (triple o) (triple d) (unit_of_directions most)
  | ForOneDirection first most =>
      QuotientBinary.fmet_parallel plane (triple first) (triple o) (triple d) (unit_of_origins most)
  | ForAnyRays => QuotientBinary.fmet_alone plane (triple o) (triple d)
  end.
Definition recorded_sure (s : surface) : bool := holds (arguments s) RecordedQuotient.quotient_sure.
Definition recorded_t (s : surface) : float := eval (arguments s) RecordedQuotient.quotient_t.

(** t, where the recorded test is true, and t finite; otherwise integers divide: measures.py,
    [Prepared.meet]. *)
Definition recorded_quotient (s : surface) : option number :=
  if recorded_sure s && BinarySingleNaN.is_finite (recorded_t s)
  then Some (Finite (BinarySingleNaN.B2R (recorded_t s))) else None.

(** This ray is among those that the plane was prepared for: no component of its direction, or of
    o - first as computed, is larger in size than that of [most]. Where the unit overflows nothing
    is asked: then the test is false. *)
Definition no_larger (v most : vec) : Prop :=
  Rabs (vx v) <= Rabs (vx most) /\ Rabs (vy v) <= Rabs (vy most) /\ Rabs (vz v) <= Rabs (vz most).
Definition away (v w : vec) : vec :=
  V (rnd (vx v - vx w)) (rnd (vy v - vy w)) (rnd (vz v - vz w)).
Definition prepared_for_it : Prop :=
  match p with
  | ForOneOrigin most =>
      BinarySingleNaN.is_finite (unit_of_directions most) = true -> no_larger (reals d) (reals most)
  | ForOneDirection first most =>
      BinarySingleNaN.is_finite (unit_of_origins most) = true ->
      no_larger (away (reals o) (reals first)) (reals most)
  | ForAnyRays => True
  end.

(** ** It is T / D, rounded once *)

Lemma same_T_D s : is_stored i s ->
  let plane := QuotientBinary.surface_of (prepared_surface (floats_of i s)) in
  QuotientWhole.T0 (stored_ray i) plane = T (stored_ray i) s /\
  QuotientWhole.D0 (stored_ray i) plane = D (stored_ray i) s.
Proof. intros [_ E]. unfold T, D. rewrite E. destruct (floats_of i s); split; reflexivity. Qed.

Theorem recorded_quotient_rounds_once s t' : prepared_for_it -> is_stored i s ->
  recorded_quotient s = Some t' -> D (stored_ray i) s <> 0 /\ t' = nearest_float (t (stored_ray i) s).
Proof.
  intros P S H. unfold recorded_quotient in H.
  destruct (recorded_sure s) eqn:Q; [|discriminate].
  destruct (BinarySingleNaN.is_finite (recorded_t s)) eqn:F; [|discriminate].
  injection H as <-.
  destruct (same_T_D s S) as [ET ED].
  assert (R : D (stored_ray i) s <> 0 /\
    BinarySingleNaN.B2R (recorded_t s) = rnd (T (stored_ray i) s / D (stored_ray i) s)).
  { rewrite <- ET, <- ED. unfold prepared_for_it in P. unfold recorded_sure, recorded_t, arguments in *.
    destruct p as [most|first most|].
    - exact (QuotientBinary.binary_from_point _ (triple o) (triple d) (triple most) P Q F).
    - exact (QuotientBinary.binary_parallel _ (triple first) (triple o) (triple d) (triple most) P Q F).
    - exact (QuotientBinary.binary_alone _ (triple o) (triple d) Q F). }
  destruct R as [N R]. split; [exact N|].
  unfold nearest_float, t. rewrite <- R, Rlt_bool_true; [reflexivity|].
  apply BinarySingleNaN.abs_B2R_lt_emax.
Qed.
End Recorded.

(** The camera's rays share an origin: where [most] is what bounds.py takes, the largest |d| of them,
    this ray is among them because it is for bounds.py. *)
Lemma reach_is_enough i reach : shared i = FromOnePoint reach -> one_of_the_rays i ->
  prepared_for_it i (ForOneOrigin reach).
Proof.
  unfold one_of_the_rays. intros -> [_ [X [Y Z]]] _.
  assert (A : forall x y, at_most_in_size x y ->
    Rabs (BinarySingleNaN.B2R x) <= Rabs (BinarySingleNaN.B2R y)).
  { intros x y [L _]. eapply Rle_trans; [exact L | apply Rle_abs]. }
  split; [|split]; now apply A.
Qed.

(** Parallel rays: [most] is that of the rays around them. None begins farther from the first by
    component than a corner of the box that their origins are in, also as computed: rounding is
    monotone. *)
Lemma box_is_enough i low high first most : shared i = ParallelRays low high first -> one_of_the_rays i ->
  no_larger (away (reals low) (reals first)) (reals most) ->
  no_larger (away (reals high) (reals first)) (reals most) ->
  prepared_for_it i (ForOneDirection first most).
Proof.
  unfold one_of_the_rays. intros -> [_ [_ [_ [[X [Y Z]] [X' [Y' Z']]]]]] [L [M N]] [L' [M' N']] _.
  assert (A : forall l x h f m, l <= x -> x <= h -> Rabs (rnd (l - f)) <= m -> Rabs (rnd (h - f)) <= m ->
    Rabs (rnd (x - f)) <= m).
  { intros l x h f m H H' B B'. apply Rabs_le_inv in B, B'. apply Rabs_le. split.
    - apply Rle_trans with (rnd (l - f)); [apply B|]. apply Rounding.rnd_le. lra.
    - apply Rle_trans with (rnd (h - f)); [|apply B']. apply Rounding.rnd_le. lra. }
  split; [|split]; eapply A; eassumption.
Qed.

(** * The theorem *)

(** The same, if quotient.py were never sure: then [given] says nothing of it. *)
Definition never_sure (i : inputs) : inputs :=
  Inputs (ray_origin i) (ray_direction i) (shared i) (clip_start i) (clip_end i) (floats_of i)
    (settled_in i) (ordered_in i) (division i) (fun _ => None).

Record given_but_depth (i : inputs) (p : preparation) (scene : list surface)
    (batches : list (list surface)) : Prop := {
  (** All that [certified] is given, but for t by quotient.py. *)
  all_else : given (never_sure i) scene batches;
  (** What is taken of quotient.py is what was recorded of it, and finite. (Less may be taken:
      [Prepared.enter] lets integers divide also where the barycentrics are not known well.) *)
  quotient_is_recorded : forall s t', met (stored_ray i) (start i) (end_ i) scene s ->
    quotient i s = Some t' -> recorded_quotient i p s = Some t';
  (** And it was prepared for this ray. *)
  ray_is_prepared_for : prepared_for_it i p
}.

Theorem depth_is_given i p scene batches :
  given_but_depth i p scene batches -> given i scene batches.
Proof.
  intros [A Q P]. destruct A.
  assert (Quotients : forall s t', met (stored_ray i) (start i) (end_ i) scene s ->
    quotient i s = Some t' -> t' = nearest_float (t (stored_ray i) s)).
  { intros s t' M H. apply (recorded_quotient_rounds_once i p s t' P); [|now apply Q].
    now apply scene_stored; apply M. }
  constructor; assumption.
Qed.

(** Each of these is explained at [certified]. *)
Theorem certified_with_depth i p scene batches : given_but_depth i p scene batches ->
  let r := stored_ray i in
  let result := plain (code_answers i) (start i) (end_ i) batches in
  soon (fun by_ => moved_sees r (moved_ray r by_) (start i) (end_ i) scene (owner result)) /\
  match certain result with
  | BOUND | EXACT => clearly_sees r (start i) (end_ i) scene (owner result)
  | AMBIGUOUS => forall answer, ~ clearly_sees r (start i) (end_ i) scene answer
  end /\
  t_of_owner result =
    match owner result with Some s => Some (nearest_float (T r s / D r s)) | None => None end.
Proof. intros G. exact (certified (depth_is_given i p scene batches G)). Qed.

(** ** What is given does not contradict itself: all finite scenes have it, with t as it was recorded *)

Definition as_recorded (i : inputs) (p : preparation) (scene : list surface) : inputs :=
  Inputs (ray_origin i) (ray_direction i) (shared i) (clip_start i) (clip_end i) (floats_of i)
    (fun _ _ => everything i scene) (fun _ _ => everything i scene) divided (recorded_quotient i p).

Theorem given_but_depth_is_possible i p scene :
  finite (ray_origin i) -> finite (ray_direction i) -> one_of_the_rays i ->
  (forall s, In s scene -> is_stored i s) ->
  (forall s s', In s scene -> In s' scene -> called s = called s' -> s = s') -> NoDup scene ->
  BinarySingleNaN.is_finite (clip_start i) = true -> BinarySingleNaN.is_nan (clip_end i) = false ->
  clip_end i <> BinarySingleNaN.B754_infinity true -> prepared_for_it i p ->
  given_but_depth (as_recorded i p scene) p scene [scene].
Proof.
  intros O D W S N U A B C P. constructor.
  - exact (given_is_possible i scene O D W S N U A B C).
  - intros s t' _ H. exact H.
  - exact P.
Qed.
