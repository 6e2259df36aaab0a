(** packages/verify/verify.py: what the checker of certificates decides of one pixel, in integers.

    Names are those of the Python code, most of them. [LeafCode.v] proves that these functions are the
    recorded ones, [LeafYes.v] that a yes is right. *)
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
  rims : list (Z * Integers * Integers); (* of [Hit.edges]: e = d . m, m and the edge *)
  along : Integers (* the ray's direction *)
}.
Definition AXES := PERTURBATION.
Definition values (h : Met) : list Z := map (fun '(e, _, _) => e) (rims h).

(** [moved]: the first that is not zero. *)
Definition moved (e : Z) (m edge d : Integers) (moves : list Integers) : Z :=
  zfirst (e :: map (_dot m) moves ++
          if is_zero m then concat (rows edge (d :: moves) moves) else []).

(** [Hit.is_crossed] *)
Definition is_crossed (moves : list Integers) (h : Met) : bool :=
  forallb (fun '(e, m, edge) => 0 <? bottom h * moved e m edge (along h) moves) (rims h).

(** [Hit.line] and [Hit.is_before] *)
Definition line (h other : Met) : Integers * Integers :=
  let w n n' := top h * n' - top other * n in
  let n := normal h in let n' := normal other in
  (I3 (w (ix n) (ix n')) (w (iy n) (iy n')) (w (iz n) (iz n')),
   if top h =? 0 then _cross n n' else ZERO).
Definition order (moves : list Integers) (h other : Met) : Z :=
  let '(m, edge) := line h other in
  moved (top h * bottom other - top other * bottom h) m edge (along h) moves * bottom h * bottom other.
Definition is_before (moves : list Integers) (h other : Met) : bool :=
  let order := order moves h other in
  (order <? 0) || ((order =? 0) && Contest.name_before (named h) (named other)).

(** [Hit.at]: fractions, which Python compares exactly. *)
Definition compare_ratios (T D T' D' : Z) : comparison :=
  Z.compare (T * D * (D' * D')) (T' * D' * (D * D)).
Definition compare_at (h other : Met) : comparison :=
  compare_ratios (top h) (bottom h) (top other) (bottom other).

(** ** [Exact.surface_from] and [Exact.hit] *)

Definition of_triangle (o a b c : Integers) : Z * Integers * list (Integers * Integers) :=
  let a := _sub a o in let b := _sub b o in let c := _sub c o in
  let n := _cross (_sub a b) (_sub b c) in
  (_dot a n, n, [(_cross a b, _sub a b); (_cross b c, _sub b c); (_cross c a, _sub c a)]).
Definition of_plane (o p n : Integers) : Z * Integers * list (Integers * Integers) :=
  (_dot (_sub p o) n, n, []).

(** The clip range's ends are fractions; that of infinity is (1, 0). *)
Definition ends (start end_ : Z * Z) (top bottom : Z) : list Z :=
  [top * snd start - fst start * bottom; fst end_ * bottom - top * snd end_].
Definition mixed (signs : list Z) : bool := (min_ signs <? 0) && (0 <? max_ signs).
Definition hit (start end_ : Z * Z) (name : Contest.name) (d : Integers)
    (surface : Z * Integers * list (Integers * Integers)) : option Met :=
  let '(top, n, sides) := surface in
  let bottom := _dot d n in
  let rims := map (fun '(m, side) => (_dot d m, m, side)) sides in
  if bottom =? 0 then None else
  if mixed (ends start end_ top bottom ++ map (fun '(e, _, _) => e) rims) then None else
  if (top =? fst start) && (fst start =? 0) then None
  else Some (MakeMet name top bottom n rims d).

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
Definition inside (hits : list Met) : list Met := filter (fun h => negb (on_edge h)) hits.
Definition not_behind (h other : Met) : bool :=
  match compare_at h other with Gt => false | _ => true end.
Definition front (hits : list Met) : list Met :=
  filter (fun h => forallb (not_behind h) (inside hits)) hits.
(** What is seen; and whether there are ties: which, is left open here. *)
Definition sees (hits : list Met) : option Met * bool :=
  match front hits, inside hits with
  | [], _ => (None, false)
  | [h], _ :: _ => (Some h, false)
  | _, _ => (first AXES hits, true)
  end.

(** ** One pixel *)

(** What is stored of it and of the scene; the numbers that one power of two is for; and the clip range
    as fractions. *)
Record pixel := Pixel {
  origin : CodeAnswers.floats;
  direction : CodeAnswers.floats;
  clip_start : float;
  clip_end : float;
  floats_of : Contest.surface -> CodeAnswers.stored;
  together : list R;
  start_ratio : Z * Z;
  end_ratio : Z * Z;
  division : Z -> Z -> option R (* Python's n / d, None for an OverflowError *)
}.
Section Pixel.
Variable p : pixel.
Definition stored_ray : ray := Ray (CodeAnswers.reals (origin p)) (CodeAnswers.reals (direction p)).
Definition start : R := BinarySingleNaN.B2R (clip_start p).
Definition end_ : Contest.number := CodeAnswers.number_of (clip_end p).
Definition whole (v : vec) : Integers := CodeAnswers.integers_of (together p) v.
Definition exact_hit (s : Contest.surface) : option Met :=
  let o := whole (CodeAnswers.reals (origin p)) in
  hit (start_ratio p) (end_ratio p) (Contest.called s) (whole (CodeAnswers.reals (direction p)))
    match Contest.shape_of s with
    | Contest.Triangular x => of_triangle o (whole (ca x)) (whole (cb x)) (whole (cc x))
    | Contest.Infinite q n => of_plane o (whole q) (whole n)
    end.
Definition hits (kept : list Contest.surface) : list Met :=
  flat_map (fun s => match exact_hit s with Some h => [h] | None => [] end) kept.

(** What a pixel sees of the surfaces that floats have kept: name, t, and whether it is ambiguous. None is
    for an OverflowError, which ends the program: that is no yes. *)
Definition NOWHERE : Contest.name := (-1, -1).
Definition answer := (Contest.name * Contest.number * bool)%type.
Definition found (kept : list Contest.surface) : option answer :=
  let '(seen, ties) := sees (hits kept) in
  match seen with
  | Some h => option_map (fun t => (named h, Contest.Finite t, ties)) (division p (top h) (bottom h))
  | None => Some (NOWHERE, Contest.Infinity, ties)
  end.
End Pixel.
