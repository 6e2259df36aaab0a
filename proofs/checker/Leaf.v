(** packages/verify/verify.py: what the checker of certificates decides of one pixel, in integers.

    Names are those of the Python code, and so is the order of its steps. [LeafCode.v] proves that
    these functions are the recorded ones, [LeafRight.v] that a yes is right. *)
Require Import ZArith Reals List Bool.
From Flocq Require Import Core.
From Flocq Require BinarySingleNaN.
From Reftrace Require Import Geometry Trees Integers Ties.
From Reftrace Require Contest CodeAnswers.
Import ListNotations.
Open Scope Z_scope.

(** ** [Hit] *)

Record Met := MakeMet {
  named : Contest.name;
  top : Z; bottom : Z; (* t = top / bottom *)
  normal : Integers;
  values : list Z; (* of the edges: e = d . m *)
  rims : list (Integers * Integers); (* m, and the edge: [Hit.edges] *)
  turn : Z; (* -1 where the edges are the other way round *)
  along : Integers (* the ray's direction *)
}.
Definition AXES := PERTURBATION.

(** [moved]: the first that is not zero. *)
Definition moved (e : Z) (m edge d : Integers) (moves : list Integers) : Z :=
  zfirst (e :: map (_dot m) moves ++
          if is_zero m then concat (rows edge (d :: moves) moves) else []).

(** [Hit.is_crossed] *)
Definition is_crossed (moves : list Integers) (h : Met) : bool :=
  forallb (fun '(e, (m, edge)) => 0 <? turn h * moved e m edge (along h) moves)
    (combine (values h) (rims h)).

(** [Hit.line] and [Hit.is_before] *)
Definition line (h other : Met) : Integers * Integers :=
  let w n n' := top h * n' - top other * n in
  let n := normal h in let n' := normal other in
  (I3 (w (ix n) (ix n')) (w (iy n) (iy n')) (w (iz n) (iz n')),
   if top h =? 0 then _cross n n' else ZERO).
Definition order (moves : list Integers) (h other : Met) : Z :=
  let '(m, edge) := line h other in
  moved (top h * bottom other - top other * bottom h) m edge (along h) moves.
Definition is_before (moves : list Integers) (h other : Met) : bool :=
  let order := order moves h other in
  (order <? 0) || ((order =? 0) && Contest.name_before (named h) (named other)).

(** [Hit.at]: fractions, which Python compares exactly. *)
Definition compare_at (h other : Met) : comparison :=
  Z.compare (top h * bottom other) (top other * bottom h).

(** ** [Exact.surface] and [Exact.hit] *)

Definition of_triangle (o a b c : Integers) : Z * Integers * list (Integers * Integers) :=
  let a := _sub a o in let b := _sub b o in let c := _sub c o in
  let n := _add (_add (_cross a b) (_cross b c)) (_cross c a) in
  (_dot a n, n, [(_cross a b, _sub a b); (_cross b c, _sub b c); (_cross c a, _sub c a)]).
Definition of_plane (o p n : Integers) : Z * Integers * list (Integers * Integers) :=
  (_dot (_sub p o) n, n, []).

(** The clip range's ends are fractions; that of infinity is (1, 0). *)
Definition clipped (start end_ : Z * Z) (top bottom : Z) : bool :=
  (top * snd start <? fst start * bottom) || (fst end_ * bottom <? top * snd end_)
  || ((top =? fst start) && (fst start =? 0)).
Definition turned_round (is_back : bool) (top bottom : Z) (n : Integers) : Z * Z * Integers :=
  if is_back then (- top, - bottom, _sub ZERO n) else (top, bottom, n).
Definition hit (start end_ : Z * Z) (name : Contest.name) (d : Integers)
    (surface : Z * Integers * list (Integers * Integers)) : option Met :=
  let '(top, n, rims) := surface in
  let values := map (fun rim => _dot d (fst rim)) rims in
  let bottom := match values with [] => _dot d n | _ => sum values end in
  if bottom =? 0 then None else
  if (min_ values <? 0) && (0 <? max_ values) then None else
  let '(top, above, n) := turned_round (bottom <? 0) top bottom n in
  if clipped start end_ top above then None
  else Some (MakeMet name top above n values rims (if 0 <? bottom then 1 else -1) d).

(** [Exact.t]: [scale] is 2^k as a fraction. *)
Definition t (division : Z -> Z -> option R) (scale : Z * Z) (h : Met) : Contest.number :=
  match division (top h * fst scale) (bottom h * snd scale) with
  | Some t => Contest.Finite t
  | None => if 0 <? top h then Contest.Infinity else Contest.MinusInfinity
  end.

(** ** [first] and [sees] *)

Definition nearer_of (moves : list Integers) (best : option Met) (h : Met) : option Met :=
  if is_crossed moves h then
    match best with
    | None => Some h
    | Some b => if is_before moves h b then Some h else best
    end
  else best.
Definition first (moves : list Integers) (hits : list Met) : option Met :=
  fold_left (nearer_of moves) hits None.

Definition on_edge (h : Met) : bool := existsb (Z.eqb 0) (values h).
Definition least_at (hits : list Met) : option Met :=
  fold_left (fun best h =>
    match best with
    | None => Some h
    | Some b => match compare_at h b with Lt => Some h | _ => best end
    end) hits None.
Definition front (hits : list Met) : list Met :=
  match least_at (filter (fun h => negb (on_edge h)) hits) with
  | None => hits
  | Some l => filter (fun h => match compare_at h l with Gt => false | _ => true end) hits
  end.
(** What is seen; and whether there are ties: which, is left open here. *)
Definition sees_among (hits : list Met) : option Met * bool :=
  (first AXES hits,
   match front hits, filter (fun h => negb (on_edge h)) hits with
   | [], _ => false
   | [_], _ :: _ => false
   | _, _ => true
   end).
Definition sees (hits : list Met) : option Met * bool :=
  match hits with
  | [h] => if on_edge h then sees_among hits else (Some h, false)
  | _ => sees_among hits
  end.

(** ** One pixel *)

(** What is stored of it and of the scene; the integers' powers of two, by what has them in common;
    and what Python's [Fraction] makes of the clip range and of the power of two of t. *)
Record pixel := Pixel {
  origin : CodeAnswers.floats;
  direction : CodeAnswers.floats;
  clip_start : float;
  clip_end : float;
  floats_of : Contest.surface -> CodeAnswers.stored;
  together : CodeAnswers.batch; (* the numbers that one power of two is for *)
  start_ratio : Z * Z;
  end_ratio : Z * Z;
  scale : Z * Z;
  division : Z -> Z -> option R (* Python's n / d, None for an OverflowError *)
}.
Section Pixel.
Variable p : pixel.
Definition stored_ray : ray := Ray (CodeAnswers.reals (origin p)) (CodeAnswers.reals (direction p)).
Definition start : R := BinarySingleNaN.B2R (clip_start p).
Definition end_ : Contest.number := CodeAnswers.number_of (clip_end p).
Definition length_of (v : vec) := CodeAnswers.integers_of (CodeAnswers.lengths (together p)) v.
Definition o : Integers := length_of (CodeAnswers.reals (origin p)).
Definition d : Integers :=
  CodeAnswers.integers_of (CodeAnswers.directions (together p)) (CodeAnswers.reals (direction p)).
Definition exact_hit (s : Contest.surface) : option Met :=
  hit (start_ratio p) (end_ratio p) (Contest.called s) d
    match Contest.shape_of s with
    | Contest.Triangular x => of_triangle o (length_of (ca x)) (length_of (cb x)) (length_of (cc x))
    | Contest.Infinite q n =>
        of_plane o (length_of q) (CodeAnswers.integers_of (CodeAnswers.components n) n)
    end.
Definition hits (kept : list Contest.surface) : list Met :=
  flat_map (fun s => match exact_hit s with Some h => [h] | None => [] end) kept.

(** What a pixel sees of the surfaces that floats have kept: name, t, and whether it is ambiguous. *)
Definition NOWHERE : Contest.name := (-1, -1).
Definition answer := (Contest.name * Contest.number * bool)%type.
Definition found (kept : list Contest.surface) : answer :=
  let '(seen, ties) := sees (hits kept) in
  match seen with
  | Some h => (named h, t (division p) (scale p) h, ties)
  | None => (NOWHERE, Contest.Infinity, ties)
  end.
End Pixel.
