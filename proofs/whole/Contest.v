(** A model of [plain] for one ray: who is nearest among a scene's surfaces, as the tracer finds it.

    It follows ladder.py and ties.py step by step; comments name the function. What is
    computed for a surface, or for two, are [answers]: here they are any; [Whole.v] says what they
    must be. Rays do not depend on one another, so that one of them is enough. *)
Require Import ZArith Reals List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry.
Import ListNotations.
Open Scope R_scope.

(** ** Surfaces: triangles, and infinite planes by a point and a normal. Each has a name. *)

Definition name := (Z * Z)%type. (* instance and triangle *)
Inductive shape := Triangular (s : triangle) | Infinite (point normal : vec).
Record surface := Surface { called : name; shape_of : shape }.

Definition T (r : ray) (s : surface) : R :=
  match shape_of s with
  | Triangular x => numerator r x
  | Infinite p n => dot (vsub p (origin r)) n
  end.
Definition D (r : ray) (s : surface) : R :=
  match shape_of s with
  | Triangular x => denominator r x
  | Infinite p n => dot (direction r) n
  end.
Definition t (r : ray) (s : surface) : R := T r s / D r s.

(** The line of the ray meets the surface, edges included; and at none. A line that is parallel to
    a surface, or lies in its plane, does not meet it. *)
Definition meets_closed (r : ray) (s : surface) : Prop :=
  match shape_of s with Triangular x => meets r x | Infinite _ _ => D r s <> 0 end.
Definition meets_within (r : ray) (s : surface) : Prop :=
  match shape_of s with Triangular x => meets_inside r x | Infinite _ _ => D r s <> 0 end.

(** In Python (instance, triangle) < (instance', triangle'). *)
Definition name_before (a b : name) : bool :=
  ((fst a <? fst b) || ((fst a =? fst b) && (snd a <? snd b)))%Z.
Definition before (s s' : surface) : bool := name_before (called s) (called s').

(** ** Floats but NaN, which occurs in no interval *)

Inductive number := MinusInfinity | Finite (x : R) | Infinity.

Definition less (a b : number) : bool :=
  match a, b with
  | Infinity, _ | _, MinusInfinity => false
  | MinusInfinity, _ | _, Infinity => true
  | Finite x, Finite y => Rlt_bool x y
  end.
Definition less_eq (a b : number) : bool := negb (less b a).
Definition least (a b : number) : number := if less b a then b else a.
Definition is_finite (a : number) : bool := match a with Finite _ => true | _ => false end.

(** ** What is computed for one ray *)

Inductive order := NEARER | COPLANAR | FARTHER | UNDECIDED.

Record answers := Answers {
  possible : surface -> bool; (* ladder.py, [sides]; of an infinite plane both are true *)
  sure : surface -> bool;
  interval_low : surface -> number; (* bounds.py, [Fractions.interval] *)
  interval_high : surface -> number;
  order_applies : bool; (* order.py *)
  order_of : surface -> surface -> order;
  two_by_two : bool; (* whether candidates are compared in rounds, as decisions.py does *)
  hit : surface -> bool; (* exact.py: whether [IntegerBatch.hit] is not None *)
  on_edge : surface -> bool;
  is_crossed : surface -> bool; (* by the moved ray *)
  gap : surface -> surface -> comparison; (* Lt: the first is nearer *)
  sign_of_difference : surface -> surface -> comparison; (* for the moved ray *)
  computed_t : surface -> number (* quotient.py, or [IntegerBatch.t] *)
}.

Inductive certainty := BOUND | EXACT | AMBIGUOUS.
Record result := Result { owner : option surface; certain : certainty; t_of_owner : option number }.

Section Plain.
Variable a : answers.
Variable start : R. (* the clip range *)
Variable end_ : number.

(** ** ladder.py: the error bound *)

(** [in_range] *)
Definition high (s : surface) : number := interval_high a s.
Definition behind : bool := Rlt_bool start 0. (* the ray sees what is behind its origin *)
Definition low (s : surface) : number :=
  if behind then if is_finite (high s) then interval_low a s else MinusInfinity
  else interval_low a s.
Definition in_range (s : surface) : bool :=
  less (Finite start) (interval_low a s) && less (high s) end_.
Definition SURE (s : surface) : bool := sure a s && is_finite (high s) && in_range s.
Definition outside (s : surface) : bool :=
  (less (high s) (Finite start) || less end_ (interval_low a s))
  && (if behind then is_finite (high s) else true).

(** [Ladder.test] and [_candidates]. What is known so far: the nearest hit is not farther than [farthest], and is among [kept]. *)
Record contest := Contest { farthest : number; kept : list surface }.
Definition nothing_yet : contest := Contest Infinity [].

(** Of a batch of pairs, those that are possible: first what is sure, then who may be nearest. *)
Definition nearest_sure (f : number) (pairs : list surface) : number :=
  fold_left (fun f s => if SURE s then least f (high s) else f) pairs f.
Definition enter (c : contest) (batch : list surface) : contest :=
  let pairs := filter (possible a) batch in
  let f := nearest_sure (farthest c) pairs in
  Contest f (kept c ++ filter (fun s => negb (outside s) && less_eq (low s) f) pairs).

(** ** ties.py *)

(** [_first]: the nearest hit of the moved ray. *)
Definition nearer_of (best : option surface) (s : surface) : option surface :=
  if is_crossed a s then
    match best with
    | None => Some s
    | Some b =>
        match sign_of_difference a s b with
        | Lt => Some s
        | Eq => if before s b then Some s else best
        | Gt => best
        end
    end
  else best.
Definition first (hits : list surface) : option surface := fold_left nearer_of hits None.

(** [seen_and_ties]: the first of those that are met at no edge, and all that is not behind it.
    There are ties, unless that is nothing, or one that is met at no edge. *)
Definition least_by_gap (hits : list surface) : option surface :=
  fold_left (fun best s =>
    match best with
    | None => Some s
    | Some b => match gap a s b with Lt => Some s | _ => best end
    end) hits None.
Definition front (hits : list surface) : list surface :=
  match least_by_gap (filter (fun s => negb (on_edge a s)) hits) with
  | None => hits
  | Some l => filter (fun s => match gap a s l with Gt => false | _ => true end) hits
  end.
Definition no_ties (hits : list surface) : bool :=
  match front hits with [] => true | [s] => negb (on_edge a s) | _ => false end.

(** ** ladder.py: integers *)

Definition entry (s : option surface) (c : certainty) : result :=
  Result s c (option_map (computed_t a) s).

(** [Decisions.by_integers] *)
Definition by_integers (found : list surface) : result :=
  let hits := filter (hit a) found in
  entry (first hits) (if no_ties hits then EXACT else AMBIGUOUS).

(** ** ladder.py: the order of depths *)

(** Whoever is left of those that were compared has those with it that lie in its plane and were
    beaten by their names alone: [tied] of the code. None: a comparison is undecided. *)
Definition entrant := (surface * list surface)%type.
Definition meet (one other : entrant) : option entrant :=
  match order_of a (fst one) (fst other) with
  | NEARER => Some one
  | FARTHER => Some other
  | COPLANAR => Some (fst one, snd one ++ fst other :: snd other)
  | UNDECIDED => None
  end.
(** One by one: the nearest so far, and the next. *)
Definition one_by_one (those : list entrant) : option entrant :=
  match those with
  | [] => None
  | first :: rest =>
      fold_left (fun best other => match best with Some one => meet one other | None => None end)
        rest (Some first)
  end.

(** decisions.py, [tournament]: in each round, every second one meets the one before it. *)
Fixpoint round (those : list entrant) : option (list entrant) :=
  match those with
  | one :: other :: rest =>
      match meet one other, round rest with
      | Some stays, Some others => Some (stays :: others)
      | _, _ => None
      end
  | _ => Some those
  end.
Fixpoint rounds (n : nat) (those : list entrant) : option entrant :=
  match those, n with
  | [stays], _ => Some stays
  | _, S n => match round those with Some fewer => rounds n fewer | None => None end
  | _, O => None
  end.

Definition nearest_of (those : list entrant) : option entrant :=
  if two_by_two a then rounds (length those) those else one_by_one those.

(** [np.lexsort] by the names. *)
Fixpoint insert (s : surface) (sorted : list surface) : list surface :=
  match sorted with
  | [] => [s]
  | x :: rest => if before x s then x :: insert s rest else s :: sorted
  end.
Definition by_name (found : list surface) : list surface := fold_right insert [] found.

(** [Decisions.by_order] *)
Definition by_order (found : list surface) : option result :=
  match nearest_of (map (fun s => (s, [])) (by_name found)) with
  | Some (s, tied) => Some (entry (Some s) (match tied with [] => EXACT | _ => AMBIGUOUS end))
  | None => None
  end.

(** ** [Ladder.hits] *)
Definition found (c : contest) : list surface :=
  filter (fun s => less_eq (low s) (farthest c)) (kept c).
Definition hits (c : contest) : result :=
  match found c with
  | [] => entry None BOUND
  | [s] => if SURE s then entry (Some s) BOUND else by_integers [s]
  | several =>
      if order_applies a && forallb SURE several then
        match by_order several with Some result => result | None => by_integers several end
      else by_integers several
  end.

(** plain.py: the planes are batches of one. *)
Definition plain (batches : list (list surface)) : result :=
  hits (fold_left enter batches nothing_yet).

End Plain.
