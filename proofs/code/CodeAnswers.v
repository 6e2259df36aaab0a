(** What the code computes for one stored ray and a scene's stored surfaces: [code_answers].

    Everything that is computed in binary64 is an evaluation of what the bridge has recorded
    (recorded/); everything in Python's integers is the functions of Integers.v, Clip.v and Hits.v.
    [Certified.v] proves that these answers are what the theorem of Nearby.v asks for. *)
Require Import ZArith Reals Psatz List String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees RecordedBounds RecordedDecisions Pairs.
From Reftrace Require Contest Facts Integers Clip Ties Hits.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.

(** ** What is stored *)

Record floats := F3 { fx : float; fy : float; fz : float }.
Definition finite (v : floats) : Prop :=
  is_finite (fx v) = true /\ is_finite (fy v) = true /\ is_finite (fz v) = true.
Definition reals (v : floats) : vec := V (B2R (fx v)) (B2R (fy v)) (B2R (fz v)).

Inductive stored := StoredTriangle (a b c : floats) | StoredPlane (point normal : floats).
Definition all_finite (s : stored) : Prop :=
  match s with
  | StoredTriangle a b c => finite a /\ finite b /\ finite c
  | StoredPlane p n => finite p /\ finite n
  end.
Definition shape_stored (s : stored) : Contest.shape :=
  match s with
  | StoredTriangle a b c => Contest.Triangular (Triangle (reals a) (reals b) (reals c))
  | StoredPlane p n => Contest.Infinite (reals p) (reals n)
  end.

(** What the rays of a contest share: an origin, with the largest |d| of them ([reach]); or a
    direction, with a box that has their origins in it, and the first of these; or nothing. *)
Inductive kind :=
| FromOnePoint (reach : floats)
| ParallelRays (low high first : floats)
| NothingShared.

(** The integers of a batch depend on all that is in it: the coordinates of origins, corners and
    points have one power of two, those of directions another. *)
Record batch := Batch { lengths : list R; directions : list R }.

Record inputs := Inputs {
  ray_origin : floats;
  ray_direction : floats;
  shared : kind;
  clip_start : float;
  clip_end : float;
  floats_of : Contest.surface -> stored; (* of a scene's surface *)
  (* the batch in which ladder.py asks integers about surfaces, and that of order.py *)
  settled_in : Contest.surface -> Contest.surface -> batch;
  ordered_in : Contest.surface -> Contest.surface -> batch;
  division : Z -> Z -> option R; (* Python's n / d, None for an OverflowError *)
  quotient : Contest.surface -> option Contest.number (* t by quotient.py, where that is sure *)
}.

(** Infinities are numbers in a contest; NaN is none of its ends ([ends_are_numbers]). *)
Definition number_of (x : float) : Contest.number :=
  match x with
  | B754_infinity true => Contest.MinusInfinity
  | B754_infinity false | B754_nan => Contest.Infinity
  | _ => Contest.Finite (B2R x)
  end.

Section Code.
Variable i : inputs.
Notation o := (ray_origin i).
Notation d := (ray_direction i).
Definition stored_ray : ray := Ray (reals o) (reals d).
Definition start : R := B2R (clip_start i).
Definition end_ : Contest.number := number_of (clip_end i).

(** ** In binary64 *)

(** The recorded trees' variables: "ax" is the x of a, and so on. *)
Definition vector (name : string) (v : floats) (others : string -> float) : string -> float :=
  named (name ++ "x") (fx v) (named (name ++ "y") (fy v) (named (name ++ "z") (fz v) others)).
Definition absolute (v : floats) : floats := F3 (Babs (fx v)) (Babs (fy v)) (Babs (fz v)).
Definition of_kind : string -> float :=
  match shared i with
  | FromOnePoint reach => vector "r" reach nothing
  | ParallelRays low high first => vector "l" low (vector "h" high (vector "o0" first nothing))
  | NothingShared => vector "r" (absolute d) nothing (* pair by pair: FromPoint, with |d| *)
  end.
Definition of_pair (s : stored) : env :=
  given (vector "o" o (vector "d" d (match s with
    | StoredTriangle a b c => vector "a" a (vector "b" b (vector "c" c of_kind))
    | StoredPlane p n => vector "p" p (vector "n" n of_kind)
    end))).

(** [sides] *)
Definition sides_env (s : stored) : env :=
  match shared i with
  | ParallelRays _ _ _ => of_sides (of_pair s) parallel_error parallel_ab parallel_bc parallel_ca
  | _ => of_sides (of_pair s) from_point_error from_point_ab from_point_bc from_point_ca
  end.
Definition code_possible (s : Contest.surface) : bool :=
  match floats_of i s with
  | StoredTriangle _ _ _ => holds (sides_env (floats_of i s)) sides_possible
  | StoredPlane _ _ => true
  end.
Definition code_sure (s : Contest.surface) : bool :=
  match floats_of i s with
  | StoredTriangle _ _ _ => holds (sides_env (floats_of i s)) sides_sure
  | StoredPlane _ _ => true
  end.

(** [Fractions.interval] *)
Definition interval_env (s : stored) : env :=
  let v := of_pair s in
  match s, shared i with
  | StoredPlane _ _, _ => of_interval v plane_T plane_T_error plane_D plane_D_error
  | _, ParallelRays _ _ _ =>
      of_interval v parallel_T parallel_T_error parallel_D parallel_D_error
  | _, _ => of_interval v from_point_T from_point_T_error from_point_D from_point_D_error
  end.
Definition low_float (s : Contest.surface) : float :=
  eval (interval_env (floats_of i s)) RecordedBounds.interval_low.
Definition high_float (s : Contest.surface) : float :=
  eval (interval_env (floats_of i s)) RecordedBounds.interval_high.

(** ** In integers *)

Definition integers_of (xs : list R) (v : vec) : Integers.Integers :=
  Integers.I3 (Integers.shifted xs (vx v)) (Integers.shifted xs (vy v)) (Integers.shifted xs (vz v)).
Definition exponent_of (xs : list R) : Z := snd (Integers.integers xs).
(** A plane's normal has a power of two of its own. *)
Definition components (v : vec) : list R := [vx v; vy v; vz v].

Section Batch.
Variable b : batch.
Notation L := (integers_of (lengths b)).
Definition origin_in : Integers.Integers := L (reals o).
Definition direction_in : Integers.Integers := integers_of (directions b) (reals d).
Definition unit_in : Z := exponent_of (lengths b).
Definition shift_in : Z := Integers.shift unit_in (exponent_of (directions b)).

(** [IntegerBatch.hit], before and after [_clipped]. *)
Definition line_hit (s : Contest.surface) : option Integers.Hit :=
  match Contest.shape_of s with
  | Contest.Triangular x => Integers.hit direction_in origin_in (L (ca x)) (L (cb x)) (L (cc x))
  | Contest.Infinite p n => Some (Integers.plane_hit direction_in origin_in (L p) (integers_of (components
    n) n))
  end.
Definition end_limit : option R :=
  match end_ with Contest.Finite e => Some e | _ => None end.
Definition is_open : bool := Req_bool start 0.
Definition code_hit (s : Contest.surface) : option Integers.Hit :=
  match line_hit s with
  | Some h =>
      Clip._seen (Clip._limit shift_in (Some start)) (Clip._limit shift_in end_limit) is_open h
  | None => None
  end.
(** [IntegerBatch.t] *)
Definition integer_t (h : Integers.Hit) : Contest.number :=
  match Clip.t_ (division i) shift_in h with
  | Some t => Contest.Finite t
  | None =>
      if Bool.eqb (0 <? Integers.numerator_ h)%Z (0 <? Integers.denominator_ h)%Z
      then Contest.Infinity else Contest.MinusInfinity
  end.
End Batch.

Definition alone s := settled_in i s s.
Definition asked {A} (s : Contest.surface) (f : Integers.Hit -> A) (other : A) : A :=
  match code_hit (alone s) s with Some h => f h | None => other end.
Definition compared (f : Integers.Hit -> Integers.Hit -> Z) (s s' : Contest.surface) : comparison :=
  match code_hit (settled_in i s s') s, code_hit (settled_in i s s') s' with
  | Some h, Some h' => Z.compare (f h h') 0
  | _, _ => Eq
  end.

(** ** order.py *)

(** [of_first_ray], of a batch with all that is around: T, D and n, for the first origin if the rays
    are parallel. *)
Definition first_origin : vec :=
  match shared i with ParallelRays _ _ first => reals first | _ => reals o end.
Definition of_first_ray (b : batch) (s : Contest.surface) : Z * Z * Integers.Integers :=
  let L := integers_of (lengths b) in
  let o := L first_origin in
  match Contest.shape_of s with
  | Contest.Triangular x =>
      let '(t, n, _, _) := Integers._triangle o (L (ca x)) (L (cb x)) (L (cc x)) in
      (t, Integers._dot (direction_in b) n, n)
  | Contest.Infinite p n =>
      let n := integers_of (components n) n in
      (Integers._dot (Integers._sub (L p) o) n, Integers._dot (direction_in b) n, n)
  end.

(** [_difference]: f0 and v are scaled by a power of two, and rounded once ([num] is Flocq's). *)
Definition bit_length (n : Z) : Z := Digits.Zdigits radix2 n.
Definition combined (by1 by2 : Z) (n1 n2 : Integers.Integers) : Integers.Integers :=
  let part a b := (by1 * b - by2 * a)%Z in
  Integers.I3 (part (Integers.ix n1) (Integers.ix n2)) (part (Integers.iy n1) (Integers.iy n2))
    (part (Integers.iz n1) (Integers.iz n2)).
Definition difference (b : batch) (s s' : Contest.surface) : float * floats * float :=
  let '(t1, d1, n1) := of_first_ray b s in
  let '(t2, d2, n2) := of_first_ray b s' in
  let '(base, v, same, unit) :=
    match shared i with
    | ParallelRays _ _ _ =>
        ((t1 * d2 - t2 * d1)%Z, combined d1 d2 n1 n2, Bool.eqb (0 <? d1)%Z (0 <? d2)%Z, unit_in b)
    | _ => (0%Z, combined t1 t2 n1 n2, Bool.eqb (0 <? t1)%Z (0 <? t2)%Z, 0%Z)
    end in
  let bits := Z.max (bit_length base + unit) (Z.max (bit_length (Integers.ix v))
    (Z.max (bit_length (Integers.iy v)) (bit_length (Integers.iz v)))) in
  if ((base =? 0)%Z && Integers.is_zero v)%bool then (num 0 0, F3 (num 0 0) (num 0 0) (num 0 0), num 0 0)
  else (num base (unit - bits),
        F3 (num (Integers.ix v) (- bits)) (num (Integers.iy v) (- bits)) (num (Integers.iz v) (- bits)),
        if same then num 1 0 else num (-1) 0).
Definition order_env (s s' : Contest.surface) : env :=
  let '(base, v, sign) := difference (ordered_in i s s') s s' in
  given (named "base" base (named "v1" (fx v) (named "v2" (fy v) (named "v3" (fz v)
    (named "sign" sign (vector "o" o (vector "d" d of_kind))))))).
Definition is_number (x : float) (m e : Z) : bool :=
  match Bcompare x (num m e) with Some Datatypes.Eq => true | _ => false end.
Definition order_number (x : float) : Contest.order :=
  if is_number x (-1) 0 then Contest.NEARER
  else if is_number x 0 0 then Contest.COPLANAR
  else if is_number x 1 0 then Contest.FARTHER
  else Contest.UNDECIDED.
Definition code_order (s s' : Contest.surface) : Contest.order :=
  order_number (eval (order_env s s')
    match shared i with ParallelRays _ _ _ => order_parallel | _ => order_from_point end).
Definition code_order_applies : bool :=
  match shared i with
  | FromOnePoint _ => Rle_bool 0 start
  | ParallelRays _ _ _ => true
  | NothingShared => false
  end.

(** ** All of them *)

Definition code_answers : Contest.answers := {|
  Contest.possible := code_possible;
  Contest.sure := code_sure;
  Contest.interval_low s := number_of (low_float s);
  Contest.interval_high s := number_of (high_float s);
  Contest.order_applies := code_order_applies;
  Contest.order_of := code_order;
  Contest.two_by_two := true;
  Contest.hit s := asked s (fun _ => true) false;
  Contest.on_edge s := asked s Hits.on_edge false;
  Contest.is_crossed s := asked s (Hits.is_crossed Ties.PERTURBATION) false;
  Contest.gap := compared Integers.gap;
  Contest.sign_of_difference := compared (Hits.sign_of_difference Ties.PERTURBATION);
  Contest.computed_t s :=
    match quotient i s with Some t => t | None => asked s (integer_t (alone s)) Contest.Infinity end
|}.

(** ** What is given *)

(** The ray is one of those that share what is shared: |d| is at most [reach], o is in the box. *)
Definition at_most_in_size (x y : float) : Prop := Rabs (B2R x) <= B2R y /\ Bsign y = false.
Definition no_more (x y : float) : Prop := B2R x <= B2R y.
Definition each (P : float -> float -> Prop) (u v : floats) : Prop :=
  P (fx u) (fx v) /\ P (fy u) (fy v) /\ P (fz u) (fz v).
Definition one_of_the_rays : Prop :=
  match shared i with
  | FromOnePoint reach => finite reach /\ each at_most_in_size d reach
  | ParallelRays low high first =>
      finite low /\ finite high /\ finite first /\ each no_more low o /\ each no_more o high
  | NothingShared => True
  end.

(** A surface of the scene is what is stored of it. *)
Definition is_stored (s : Contest.surface) : Prop :=
  all_finite (floats_of i s) /\ Contest.shape_of s = shape_stored (floats_of i s).

(** A batch has the numbers in it that it is asked of. *)
Definition lengths_of (s : Contest.surface) : list R :=
  match Contest.shape_of s with
  | Contest.Triangular x => components (ca x) ++ components (cb x) ++ components (cc x)
  | Contest.Infinite p _ => components p
  end.
Definition in_lengths (b : batch) (origin : vec) (s : Contest.surface) : Prop :=
  incl (components origin ++ lengths_of s) (lengths b).
Definition in_directions (b : batch) : Prop := incl (components (reals d)) (directions b).
End Code.
