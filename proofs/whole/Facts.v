(** What [plain] says of a ray, as true or false; and the facts of single surfaces that it rests on.

    [Whole.v] proves that with these facts, all that [plain] says is true. Each of the facts is
    about one surface or two, in exact arithmetic, and says which file proves it of the code. *)
Require Import ZArith Reals Psatz List Bool Sorted Permutation.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Contest.
Import ListNotations.
Open Scope R_scope.

(** Two surfaces lie in one plane: no ray tells their T and D apart, but for a factor. *)
Definition same_plane (s s' : surface) : Prop :=
  exists k, k <> 0 /\ forall q, T q s = k * T q s' /\ D q s = k * D q s'.

(** A number that a float64 is: with an end, unlike [is_float]. *)
Definition float64 (x : R) : Prop :=
  exists f : float, BinarySingleNaN.is_finite f = true /\ BinarySingleNaN.B2R f = x.

(** x <= a real number: where float64 ends, x may only be Infinity if the number is above it. *)
Definition at_most (x : number) (y : R) : Prop :=
  match x with
  | MinusInfinity => True
  | Finite x => x <= y
  | Infinity => forall f, float64 f -> f < y
  end.

(** The float64 nearest to x, of two the even one; an infinity where that is beyond float64. *)
Definition nearest_float (x : R) : number :=
  if Rlt_bool (Rabs (rnd x)) (bpow radix2 emax) then Finite (rnd x)
  else if Rlt_bool x 0 then MinusInfinity else Infinity.

Section Facts.

(** The stored ray; one that is moved as the rule says, so little that nothing else changes; the
    camera's clip range; the scene's surfaces; and in which batches they are proposed. *)
Context {r moved : ray} {start : R} {end_ : number} {scene : list surface}.
Context {batches : list (list surface)} {a : answers}.

Definition in_clip_range (t : R) : Prop :=
  start <= t /\
  match end_ with Finite e => t <= e | Infinity => True | MinusInfinity => False end /\
  ~ (start = 0 /\ t = 0). (* a ray does not meet what it begins on *)

(** The stored ray meets s, edges included, within the clip range. *)
Definition met (s : surface) : Prop :=
  In s scene /\ meets_closed r s /\ in_clip_range (t r s).

(** The stored ray's answer is clear: s, inside, strictly before all else that it meets; or it
    meets nothing at all. *)
Definition clearly_sees (answer : option surface) : Prop :=
  match answer with
  | None => forall s, ~ met s
  | Some s => met s /\ meets_within r s /\ forall s', met s' -> s' <> s -> t r s < t r s'
  end.

(** The moved ray meets s. What is not moved is the clip range, and what the stored ray is parallel
    to is met by neither. *)
Definition moved_meets (s : surface) : Prop :=
  In s scene /\ meets_within moved s /\ D r s <> 0 /\ in_clip_range (t r s).
Definition moved_sees (answer : option surface) : Prop :=
  match answer with
  | None => forall s, ~ moved_meets s
  | Some s => moved_meets s /\ forall s', moved_meets s' -> s' <> s ->
      t moved s < t moved s' \/ (same_plane s s' /\ before s s' = true)
  end.

(** *** Of the stored ray, and what is computed for it *)
Record ray_facts : Prop := {
  (** *** The scene *)
  names_differ : forall s s', In s scene -> In s' scene -> called s = called s' -> s = s';
  (* clip ends are float64 *)
  end_is_float :
    match end_ with Finite e => float64 e | Infinity => True | MinusInfinity => False end;
  (** *** Film.v: [candidates], with the planes: nothing that is met is left out, nothing comes
      twice *)
  proposed_all : forall s, met s -> In s (concat batches);
  proposed_once : NoDup (concat batches);
  proposed_some : incl (concat batches) scene;
  (** *** Signs.v: [sides] *)
  impossible : forall s, In s scene -> possible a s = false -> ~ meets_closed r s;
  surely : forall s, In s scene -> sure a s = true ->
    match shape_of s with Triangular x => meets_inside r x | Infinite _ _ => True end;
  (** *** Interval.v: [Fractions.interval] *)
  interval_above : forall s h, In s scene -> interval_high a s = Finite h ->
    float64 h /\ D r s <> 0 /\ t r s <= h;
  interval_not_minus : forall s, In s scene -> interval_high a s <> MinusInfinity;
  interval_below : forall s, In s scene -> D r s <> 0 ->
    0 <= t r s \/ is_finite (interval_high a s) = true -> at_most (interval_low a s) (t r s);
  (** *** Order.v: [order_of], for what surely is met in the open clip range *)
  order_right : order_applies a = true -> forall s s', In s scene -> In s' scene ->
    meets_within r s -> meets_within r s' -> start < t r s -> start < t r s' ->
    match order_of a s s' with
    | NEARER => t r s < t r s'
    | FARTHER => t r s' < t r s
    | COPLANAR => same_plane s s'
    | UNDECIDED => True
    end;
  (** *** Integers.v: [hit], [on_edge], [gap] *)
  hit_right : forall s, In s scene -> (hit a s = true <-> met s);
  on_edge_right : forall s, met s -> (on_edge a s = false <-> meets_within r s);
  gap_right : forall s s', met s -> met s' -> gap a s s' = Rcompare (t r s) (t r s');
  (** *** Integers.v and Quotient.v *)
  t_right : forall s, met s -> computed_t a s = nearest_float (t r s)
}.

(** *** Ties.v: the signs of the rule are the moved ray's *)
Record rule_facts : Prop := {
  is_crossed_right : forall s, met s -> (is_crossed a s = true <-> meets_within moved s);
  sign_right : forall s s', met s -> met s' -> meets_within moved s -> meets_within moved s' ->
    match sign_of_difference a s s' with
    | Lt => t moved s < t moved s'
    | Gt => t moved s' < t moved s
    | Eq => same_plane s s'
    end
}.

(** *** Nearby.v: the moved ray is near enough *)
Record near_facts : Prop := {
  moved_stays_inside : forall s, met s -> meets_within r s -> meets_within moved s;
  moved_keeps_order : forall s s', met s -> met s' -> meets_within moved s ->
    meets_within moved s' -> t r s < t r s' -> t moved s < t moved s';
  moved_meets_no_more : forall s, In s scene -> meets_within moved s -> D r s <> 0 ->
    meets_closed r s
}.

Record facts : Prop := {
  of_ray :> ray_facts;
  of_rule :> rule_facts;
  of_near :> near_facts
}.

End Facts.
Arguments in_clip_range : clear implicits.
Arguments met : clear implicits.
Arguments clearly_sees : clear implicits.
Arguments moved_meets : clear implicits.
Arguments moved_sees : clear implicits.
Arguments ray_facts : clear implicits.
Arguments rule_facts : clear implicits.
Arguments near_facts : clear implicits.
Arguments facts : clear implicits.
