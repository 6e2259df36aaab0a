(** What the code computes and decides in integers is what Integers.v, Clip.v, Ties.v, Hits.v and
    Contest.v say: `exact.py`, `ties.py`, `order.py`, recorded as whole functions, all
    branches included ([RecordedIntegers]). Those files were written by hand from the Python; here a machine
    has compared the two. *)
Require Import ZArith Reals List Bool Lia.
From Flocq Require Import IEEE754.Binary.
From Reftrace Require Import Geometry Trees Integers Clip Ties Hits CodeAnswers RecordedIntegers.
From Reftrace Require Contest.
Import ListNotations.
Open Scope Z_scope.

(** Each test of the two is looked at both ways. *)
Ltac test t := lazymatch t with context [if _ then _ else _] => fail | _ => destruct t eqn:?H end.
Ltac each_way :=
  repeat (match goal with
          | |- context [if ?t then _ else _] => test t
          | |- context [?t && _] => test t
          | |- context [?t || _] => test t
          end; cbn [andb orb negb] in *; try congruence).

(** [IntegerBatch._triangle]: T, n, and m and span of each edge *)
Theorem triangle_is o a b c :
  whole_triangle (ix o) (iy o) (iz o) (ix a) (iy a) (iz a) (ix b) (iy b) (iz b) (ix c) (iy c) (iz c) =
  _triangle o a b c.
Proof. reflexivity. Qed.

(** [IntegerBatch.hit] *)
Theorem hit_is d o a b c :
  whole_hit (ix d) (iy d) (iz d) (ix o) (iy o) (iz o) (ix a) (iy a) (iz a) (ix b) (iy b) (iz b)
    (ix c) (iy c) (iz c) = Integers.hit d o a b c.
Proof.
  unfold whole_hit, Integers.hit. destruct (_triangle o a b c) as [[[T n] m] s] eqn:E.
  unfold _triangle in E. injection E as <- <- <- <-.
  unfold min_, max_, Integers.sum, _dot, _cross, _sub, _add; cbn [map fold_right ix iy iz].
  destruct d as [dx dy dz]; cbn [ix iy iz].
  match goal with |- (if ?p <? 0 then if 0 <? ?q then _ else _ else _) = (if (?p' <? 0) && (0 <? ?q') then _ else _) =>
    replace p' with p by lia; replace q' with q by lia; destruct (p <? 0), (0 <? q) end;
  cbn [andb]; try reflexivity;
    match goal with
    | |- Some (MakeHit ?t ?D _ _ _ _ _) = Some (MakeHit ?t ?E _ _ _ _ _) =>
        replace E with D by ring; reflexivity
    end.
Qed.
Theorem plane_is d o p n :
  whole_plane (ix d) (iy d) (iz d) (ix o) (iy o) (iz o) (ix p) (iy p) (iz p) (ix n) (iy n) (iz n) =
  Some (plane_hit d o p n).
Proof. destruct d, n; reflexivity. Qed.

(** [IntegerBatch._clipped], with and without limits *)
Section Clipped.
Variables (h : Hit) (start end_ : Z * Z) (open : bool).
Definition is_seen start end_ : bool :=
  match _seen start end_ open h with Some _ => true | None => false end.
Let n := normal_ h. Let d := direction_ h.
Notation of_hit f := (f (numerator_ h) (denominator_ h) (ix n) (iy n) (iz n) (ix d) (iy d) (iz d)
  (fst start) (snd start) (fst end_) (snd end_) open).
Ltac clipped :=
  unfold is_seen, _seen, out_of; destruct start, end_; cbn [fst snd]; rewrite ?Z.mul_1_l;
  destruct open; each_way.
Theorem clipped_both_is : of_hit whole_clipped_both = is_seen (Some start) (Some end_).
Proof. unfold whole_clipped_both. clipped. Qed.
Theorem clipped_start_is : of_hit whole_clipped_start = is_seen (Some start) None.
Proof. unfold whole_clipped_start. clipped. Qed.
Theorem clipped_end_is : of_hit whole_clipped_end = is_seen None (Some end_).
Proof. unfold whole_clipped_end. clipped. Qed.
Theorem clipped_never_is : of_hit whole_clipped_never = is_seen None None.
Proof. unfold whole_clipped_never. clipped. Qed.
End Clipped.

(** [IntegerBatch.t] *)
Theorem t_is division shift h : let n := normal_ h in let d := direction_ h in
  whole_t division (numerator_ h) (denominator_ h) (ix n) (iy n) (iz n) (ix d) (iy d) (iz d) shift =
  t_ division shift h.
Proof. reflexivity. Qed.

(** * Two hits *)
Section Two.
Variables h1 h2 : Hit.
Notation n1 := (normal_ h1). Notation n2 := (normal_ h2). Notation d := (direction_ h1).
Notation of_hits f := (f (numerator_ h1) (denominator_ h1) (ix n1) (iy n1) (iz n1)
  (numerator_ h2) (denominator_ h2) (ix n2) (iy n2) (iz n2) (ix d) (iy d) (iz d)).
Theorem gap_is : of_hits whole_gap = gap h1 h2.
Proof. reflexivity. Qed.
(** The code scales n2 by T1 where the model scales T1 by n2. *)
Lemma w_is : I3 (ix n2 * numerator_ h1 - ix n1 * numerator_ h2)
    (iy n2 * numerator_ h1 - iy n1 * numerator_ h2) (iz n2 * numerator_ h1 - iz n1 * numerator_ h2) =
  fst (intersection h1 h2).
Proof. unfold intersection; cbn [fst]. f_equal; ring. Qed.
Theorem intersection_is : of_hits whole_intersection = intersection h1 h2.
Proof.
  unfold whole_intersection. rewrite w_is. unfold intersection; cbn [fst].
  destruct (numerator_ h1 =? 0); reflexivity.
Qed.
Theorem sign_of_difference_is moves :
  of_hits whole_sign_of_difference moves = sign_of_difference moves h1 h2.
Proof.
  unfold whole_sign_of_difference. rewrite w_is. unfold sign_of_difference.
  replace (I3 (ix d) (iy d) (iz d)) with d by now destruct d.
  unfold intersection at 2 4 6 8; cbn [snd]. destruct (numerator_ h1 =? 0); reflexivity.
Qed.
End Two.

(** * The rule *)

(** [_sign], for the moves of the rule and for one way: of a list of numbers it is the sign of the
    first that is not zero ([sign_is_first]), and so the code goes through them. *)
Lemma sgn_is v : as_int (0 <? v) - as_int (v <? 0) = Z.sgn v.
Proof. now destruct v. Qed.
Ltac components := cbn [ix iy iz].
Ltac through :=
  rewrite !sgn_is, sign_is_first; unfold is_zero, rows, zfirst, _dot, _cross;
  cbn [map concat app]; components;
  match goal with |- context [(?x =? 0) && (?y =? 0) && (?z =? 0)] =>
    destruct (x =? 0), (y =? 0), (z =? 0) end;
  cbn [andb app fold_right];
  repeat match goal with |- (if ?x =? 0 then _ else _) = _ =>
    destruct (x =? 0) eqn:?E; [|reflexivity] end;
  match goal with
  | E : (?x =? 0) = true |- Z.sgn ?x = _ => apply Z.eqb_eq in E; now rewrite E
  | |- Z.sgn ?x = _ => destruct (Z.eqb_spec x 0) as [->|]; reflexivity
  end.
Theorem sign_is value m span d :
  whole_sign value (ix m) (iy m) (iz m) (ix span) (iy span) (iz span) (ix d) (iy d) (iz d) =
  _sign value m span d PERTURBATION.
Proof. unfold whole_sign, PERTURBATION. through. Qed.
Theorem sign_one_way_is value m span d u :
  whole_sign_one_way value (ix m) (iy m) (iz m) (ix span) (iy span) (iz span) (ix d) (iy d) (iz d)
    (ix u) (iy u) (iz u) = _sign value m span d [u].
Proof. unfold whole_sign_one_way. through. Qed.

(** [Hit.is_crossed], of a triangle *)
Ltac three x := destruct (Z.eqb_spec 1 x) as [<-|_]; [|destruct (Z.eqb_spec (-1) x) as [<-|_]].
Theorem is_crossed_is T D n d e1 e2 e3 m1 m2 m3 s1 s2 s3 moves :
  whole_is_crossed T D (ix n) (iy n) (iz n) (ix d) (iy d) (iz d) e1 e2 e3
    (ix m1) (iy m1) (iz m1) (ix m2) (iy m2) (iz m2) (ix m3) (iy m3) (iz m3)
    (ix s1) (iy s1) (iz s1) (ix s2) (iy s2) (iz s2) (ix s3) (iy s3) (iz s3) moves =
  is_crossed moves (MakeHit T D n [e1; e2; e3] [m1; m2; m3] [s1; s2; s3] d).
Proof.
  unfold whole_is_crossed, is_crossed, on_edge. cbn [edges sides spans direction_ combine map].
  replace (I3 (ix m1) (iy m1) (iz m1)) with m1 by now destruct m1.
  replace (I3 (ix m2) (iy m2) (iz m2)) with m2 by now destruct m2.
  replace (I3 (ix m3) (iy m3) (iz m3)) with m3 by now destruct m3.
  replace (I3 (ix s1) (iy s1) (iz s1)) with s1 by now destruct s1.
  replace (I3 (ix s2) (iy s2) (iz s2)) with s2 by now destruct s2.
  replace (I3 (ix s3) (iy s3) (iz s3)) with s3 by now destruct s3.
  replace (I3 (ix d) (iy d) (iz d)) with d by now destruct d.
  generalize (_sign e1 m1 s1 d moves) (_sign e2 m2 s2 d moves) (_sign e3 m3 s3 d moves).
  intros x y z. cbn [existsb forallb]. rewrite !(Z.eqb_sym 0).
  three x; three y; three z; destruct (e1 =? 0), (e2 =? 0), (e3 =? 0); reflexivity.
Qed.

(** [IntegerBatch.of_first_ray] *)
Theorem of_first_ray_is i b s :
  let L := integers_of (lengths b) in let o := L (first_origin i) in let d := direction_in i b in
  match Contest.shape_of s with
  | Contest.Triangular x => let p := L (ca x) in let q := L (cb x) in let r := L (cc x) in
      whole_of_first_ray (ix d) (iy d) (iz d) (ix o) (iy o) (iz o) (ix p) (iy p) (iz p)
        (ix q) (iy q) (iz q) (ix r) (iy r) (iz r)
  | Contest.Infinite p n => let p := L p in let n := integers_of (components n) n in
      whole_of_first_ray_plane (ix d) (iy d) (iz d) (ix o) (iy o) (iz o) (ix p) (iy p) (iz p)
        (ix n) (iy n) (iz n)
  end = of_first_ray i b s.
Proof. unfold of_first_ray. destruct (Contest.shape_of s); reflexivity. Qed.

(** * [order._difference], of what [of_first_ray] returns of two surfaces *)
Section Difference.
Variables (i : inputs) (b : batch) (s s' : Contest.surface) (T1 D1 T2 D2 : Z) (n1 n2 : Integers).
Hypothesis first : of_first_ray i b s = (T1, D1, n1).
Hypothesis second : of_first_ray i b s' = (T2, D2, n2).
Notation of_both f := (f T1 D1 (ix n1) (iy n1) (iz n1) T2 D2 (ix n2) (iy n2) (iz n2)).
Ltac difference :=
  unfold combined, is_zero; cbn beta iota zeta delta [ix iy iz]; change (bit_length 0) with 0; rewrite ?Z.max_assoc, ?Z.add_0_r;
  match goal with |- context [(?x =? 0) && (?y =? 0) && (?z =? 0)] =>
    destruct (x =? 0), (y =? 0), (z =? 0) end.
Theorem difference_from_point_is unit :
  match shared i with ParallelRays _ _ _ => False | _ => True end ->
  of_both whole_difference_from_point unit = difference i b s s'.
Proof.
  unfold whole_difference_from_point, difference. rewrite first, second.
  destruct (shared i); intros K; try easy; difference; cbn [andb Z.eqb];
    destruct (Bool.eqb (0 <? T1) (0 <? T2)); reflexivity.
Qed.
Theorem difference_parallel_is low high origin : shared i = ParallelRays low high origin ->
  of_both whole_difference_parallel (unit_in b) = difference i b s s'.
Proof.
  intros K. unfold whole_difference_parallel, difference. rewrite first, second, K. difference;
    destruct (T1 * D2 - T2 * D1 =? 0), (Bool.eqb (0 <? D1) (0 <? D2)); reflexivity.
Qed.
End Difference.

(** * Settling: [ties._first], and whether [seen_and_ties] has ties, of up to three hits *)
Section Settling.
Variable a : Contest.answers.
Variables s0 s1 s2 : Contest.surface.
Ltac ask x := destruct x eqn:?; cbn [fold_left filter negb is_lt is_eq is_gt]; try congruence.
Ltac compare :=
  repeat match goal with
  | |- context [Contest.is_crossed a ?s] => ask (Contest.is_crossed a s)
  | |- context [Contest.on_edge a ?s] => ask (Contest.on_edge a s)
  | |- context [Contest.sign_of_difference a ?s ?t] =>
      is_var s; is_var t; ask (Contest.sign_of_difference a s t)
  | |- context [Contest.gap a ?s ?t] => is_var s; is_var t; ask (Contest.gap a s t)
  | |- context [Contest.before ?s ?t] => is_var s; is_var t; ask (Contest.before s t)
  end.
Ltac follow := unfold Contest.first, Contest.nearer_of; cbn [fold_left]; compare.
Theorem first_of_1_is : whole_first_of_1 a s0 = Contest.first a [s0].
Proof. unfold whole_first_of_1. follow. Qed.
Theorem first_of_2_is : whole_first_of_2 a s0 s1 = Contest.first a [s0; s1].
Proof. unfold whole_first_of_2. follow. Qed.
Theorem first_of_3_is : whole_first_of_3 a s0 s1 s2 = Contest.first a [s0; s1; s2].
Proof. unfold whole_first_of_3. follow. Qed.
Ltac ties := unfold Contest.no_ties, Contest.front, Contest.least_by_gap; cbn [filter negb fold_left];
  compare.
Theorem no_ties_1_is : whole_no_ties_1 a s0 = Contest.no_ties a [s0].
Proof. unfold whole_no_ties_1. ties. Qed.
Theorem no_ties_2_is : whole_no_ties_2 a s0 s1 = Contest.no_ties a [s0; s1].
Proof. unfold whole_no_ties_2. ties. Qed.
End Settling.
