(** addon/certified/exact.py: how it makes integers of floats, and what it computes of them.

    Names are those of the Python code. Python's integers have no limit, so they are Coq's [Z]. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees.
Import ListNotations.
Open Scope R_scope.

(** * Vectors of integers *)

Record Integers := I3 { ix : Z; iy : Z; iz : Z }.
Definition ZERO := I3 0 0 0.
Definition _sub a b := I3 (ix a - ix b) (iy a - iy b) (iz a - iz b).
Definition _add a b := I3 (ix a + ix b) (iy a + iy b) (iz a + iz b).
Definition _dot a b := (ix a * ix b + iy a * iy b + iz a * iz b)%Z.
Definition _cross a b :=
  I3 (iy a * iz b - iz a * iy b) (iz a * ix b - ix a * iz b) (ix a * iy b - iy a * ix b).
Definition is_zero m := ((ix m =? 0) && (iy m =? 0) && (iz m =? 0))%Z.

(** The same vector, of real numbers. *)
Definition real (a : Integers) : vec := V (IZR (ix a)) (IZR (iy a)) (IZR (iz a)).

Lemma real_sub a b : real (_sub a b) = vsub (real a) (real b).
Proof. unfold real, _sub, vsub; simpl. now rewrite !minus_IZR. Qed.
Lemma real_add a b : real (_add a b) = vadd (real a) (real b).
Proof. unfold real, _add, vadd; simpl. now rewrite !plus_IZR. Qed.
Lemma real_dot a b : IZR (_dot a b) = dot (real a) (real b).
Proof. unfold real, _dot, dot; simpl. now rewrite !plus_IZR, !mult_IZR. Qed.
Lemma real_cross a b : real (_cross a b) = cross (real a) (real b).
Proof. unfold real, _cross, cross; simpl. now rewrite !minus_IZR, !mult_IZR. Qed.
Lemma is_zero_spec m : is_zero m = true <-> m = ZERO.
Proof.
  destruct m as [x y z]. unfold is_zero, ZERO; simpl. rewrite !andb_true_iff, !Z.eqb_eq.
  split; [intros [[-> ->] ->] | intros [= -> -> ->]]; auto.
Qed.

(** * Hits *)

Record Hit := MakeHit {
  numerator_ : Z; denominator_ : Z; normal_ : Integers;
  edges : list Z; sides : list Integers; spans : list Integers; direction_ : Integers }.

(** [IntegerBatch._triangle]: T, n, sides and spans. *)
Definition _triangle (o a b c : Integers) : Z * Integers * list Integers * list Integers :=
  let a := _sub a o in let b := _sub b o in let c := _sub c o in
  let ab := _cross a b in let bc := _cross b c in let ca := _cross c a in
  (_dot a bc, _add (_add ab bc) ca, [ab; bc; ca], [_sub a b; _sub b c; _sub c a]).
Definition sum (l : list Z) : Z := fold_right Z.add 0%Z l.
Definition min_ (l : list Z) : Z := match l with [] => 0%Z | e :: l => fold_right Z.min e l end.
Definition max_ (l : list Z) : Z := match l with [] => 0%Z | e :: l => fold_right Z.max e l end.

(** [IntegerBatch.hit], before it looks at the clip range: of a triangle, and of an infinite plane. *)
Definition hit (d o a b c : Integers) : option Hit :=
  let '(numerator, n, sides, spans) := _triangle o a b c in
  let edges := map (_dot d) sides in
  if ((min_ edges <? 0) && (0 <? max_ edges))%Z then None
  else Some (MakeHit numerator (sum edges) n edges sides spans d).
Definition plane_hit (d o point n : Integers) : Hit :=
  MakeHit (_dot (_sub point o) n) (_dot d n) n [] [] [] d.

Lemma V_eq x y z x' y' z' : x = x' -> y = y' -> z = z' -> V x y z = V x' y' z'.
Proof. now intros -> -> ->. Qed.
Lemma cons_eq (x y : R) l m : x = y -> l = m -> x :: l = y :: m.
Proof. now intros -> ->. Qed.

(** All that is what Geometry.v says of the ray and the triangle. *)
Definition real_ray o d := Ray (real o) (real d).
Definition real_triangle a b c := Triangle (real a) (real b) (real c).
Theorem hit_is_geometry d o a b c h : hit d o a b c = Some h ->
  let r := real_ray o d in let s := real_triangle a b c in
  IZR (numerator_ h) = numerator r s /\ IZR (denominator_ h) = denominator r s /\
  real (normal_ h) = normal s /\ direction_ h = d /\
  map IZR (edges h) =
    [edge r (real a) (real b); edge r (real b) (real c); edge r (real c) (real a)].
Proof.
  unfold hit. destruct (_triangle o a b c) as [[[n m] si] sp] eqn:E.
  unfold _triangle in E. injection E as <- <- <- <-.
  match goal with |- (if ?c then _ else _) = _ -> _ => destruct c end; [discriminate|].
  intros [= <-]. cbn [numerator_ denominator_ normal_ edges direction_ map sum fold_right].
  rewrite !plus_IZR, !real_dot, !real_add, !real_cross, !real_sub.
  unfold edge, numerator, denominator, normal, real_ray, real_triangle, dot, cross, vadd, vsub; simpl.
  repeat split; try ring.
  - apply V_eq; ring.
  - repeat apply cons_eq; reflexivity || ring.
Qed.

(** Without a limit of the clip range, too, [hit] says None only where e have both signs. *)
Lemma hit_none d o a b c : hit d o a b c = None <->
  let edges := map (_dot d) (snd (fst (_triangle o a b c))) in
  (min_ edges < 0 < max_ edges)%Z.
Proof.
  unfold hit. destruct (_triangle o a b c) as [[[n m] si] sp]. simpl fst. simpl snd.
  match goal with |- context [if ?c then _ else _] => destruct c eqn:E end.
  - rewrite andb_true_iff, !Z.ltb_lt in E. simpl. tauto.
  - rewrite andb_false_iff, !Z.ltb_ge in E. simpl. split; [discriminate | intros; exfalso; lia].
Qed.

(** * From floats to integers *)

(** numpy's [frexp] and [digits]: a float is mantissa * 2^exponent, with 1/2 <= |mantissa| < 1; and
    mantissa * 2^53 is an integer. *)
Definition exponent (x : R) : Z := mag radix2 x.
Definition digits (x : R) : Z := Ztrunc (x * bpow radix2 (53 - exponent x)).
Lemma digits_exact x : is_float x -> x = IZR (digits x) * bpow radix2 (exponent x - 53).
Proof.
  intros F. destruct (Req_dec x 0) as [->|N].
  { unfold digits. rewrite Rmult_0_l, Ztrunc_IZR. ring. }
  set (k := (Z.max (exponent x - 53) (-1074) - (exponent x - 53))%Z).
  assert (H : x * bpow radix2 (53 - exponent x) =
              IZR (Ztrunc (scaled_mantissa radix2 fexp x) * 2 ^ k)).
  { unfold is_float, generic_format in F. rewrite F at 1. unfold F2R; cbn [Fnum Fexp].
    rewrite mult_IZR, (IZR_Zpower radix2) by (unfold k; lia).
    rewrite Rmult_assoc, <- bpow_plus. f_equal. f_equal.
    unfold cexp, fexp, FLT_exp, k, Trees.prec, exponent. lia. }
  unfold digits. rewrite H, Ztrunc_IZR, <- H, Rmult_assoc, <- bpow_plus.
  replace (53 - exponent x + (exponent x - 53))%Z with 0%Z by lia. simpl. ring.
Qed.

(** [integers]: the least exponent of all that are not zero, and each shifted by what it has more. *)
Definition nonzero xs := filter (fun x => negb (Req_bool x 0)) xs.
Definition least (xs : list R) : Z := min_ (map exponent (nonzero xs)).
Definition shifted (xs : list R) (x : R) : Z :=
  Z.shiftl (digits x) (if Req_bool x 0 then 0 else exponent x - least xs).
Definition integers (xs : list R) : list Z * Z := (map (shifted xs) xs, (least xs - 53)%Z).

Lemma min_le l e : In e l -> (min_ l <= e)%Z.
Proof.
  destruct l as [|a l]; [easy|]. simpl. intros [->|H].
  - induction l as [|b l IH]; simpl; lia.
  - induction l as [|b l IH]; simpl in *; [easy|]. destruct H as [->|H]; [lia|]. specialize (IH H). lia.
Qed.
Theorem integers_exact xs x : In x xs -> is_float x ->
  x = IZR (shifted xs x) * bpow radix2 (snd (integers xs)).
Proof.
  intros I F. unfold shifted, integers; simpl. destruct (Req_bool_spec x 0) as [->|N].
  { unfold digits. rewrite Rmult_0_l, Ztrunc_IZR. simpl. ring. }
  assert (L : (least xs <= exponent x)%Z).
  { apply min_le, in_map, filter_In. split; [exact I|]. rewrite Req_bool_false; auto. }
  rewrite Z.shiftl_mul_pow2, mult_IZR, (IZR_Zpower radix2) by lia.
  rewrite Rmult_assoc, <- bpow_plus.
  replace (exponent x - least xs + (least xs - 53))%Z with (exponent x - 53)%Z by lia.
  now apply digits_exact.
Qed.

(** * One power of two for all lengths, one for all directions: no sign changes

    The floats are [vscale (bpow k) (real ..)]: [vscale_exact]. *)
Definition scaled k (v : Integers) : vec := vscale (bpow radix2 k) (real v).
Theorem vscale_exact xs x y z : In x xs -> In y xs -> In z xs ->
  is_float x -> is_float y -> is_float z ->
  V x y z = scaled (snd (integers xs)) (I3 (shifted xs x) (shifted xs y) (shifted xs z)).
Proof.
  intros. unfold scaled, vscale, real; simpl.
  rewrite (integers_exact xs x), (integers_exact xs y), (integers_exact xs z) at 1 by assumption.
  simpl. f_equal; ring.
Qed.

Section Scales.
Variables unit direction_unit : Z. (* [unit] and [direction_exponent] *)
Notation L := (bpow radix2 unit).
Notation M := (bpow radix2 direction_unit).
Definition float_ray o d := Ray (scaled unit o) (scaled direction_unit d).
Definition float_triangle a b c := Triangle (scaled unit a) (scaled unit b) (scaled unit c).

Lemma edge_scaled o d a b :
  edge (float_ray o d) (scaled unit a) (scaled unit b) =
  L * L * M * edge (real_ray o d) (real a) (real b).
Proof. unfold float_ray, real_ray, scaled, edge, dot, cross, vsub, vscale; simpl; ring. Qed.
Lemma numerator_scaled o d a b c :
  numerator (float_ray o d) (float_triangle a b c) =
  L * L * L * numerator (real_ray o d) (real_triangle a b c).
Proof.
  unfold numerator, normal, float_triangle, float_ray, real_triangle, real_ray, scaled, dot, cross,
    vsub, vscale; simpl; ring.
Qed.
Lemma denominator_scaled o d a b c :
  denominator (float_ray o d) (float_triangle a b c) =
  L * L * M * denominator (real_ray o d) (real_triangle a b c).
Proof.
  unfold denominator, normal, float_triangle, float_ray, real_triangle, real_ray, scaled, dot, cross,
    vsub, vscale; simpl; ring.
Qed.
(** The factors are positive, so every sign is that of the integers. A plane's normal has a power of
    two of its own: k below. *)
Lemma positive_sign k x : 0 < k -> (0 < k * x <-> 0 < x) /\ (k * x < 0 <-> x < 0) /\ (k * x = 0 <-> x = 0).
Proof. intros H. repeat split; intros; nra. Qed.
Lemma factor_pos : 0 < L * L * M.
Proof. repeat apply Rmult_lt_0_compat; apply bpow_gt_0. Qed.
Theorem edge_sign o d a b :
  let e := edge (float_ray o d) (scaled unit a) (scaled unit b) in
  let e' := edge (real_ray o d) (real a) (real b) in
  (0 < e <-> 0 < e') /\ (e < 0 <-> e' < 0) /\ (e = 0 <-> e' = 0).
Proof. simpl. rewrite edge_scaled. apply positive_sign, factor_pos. Qed.
Theorem denominator_sign o d a b c :
  let D := denominator (float_ray o d) (float_triangle a b c) in
  let D' := denominator (real_ray o d) (real_triangle a b c) in
  (0 < D <-> 0 < D') /\ (D < 0 <-> D' < 0) /\ (D = 0 <-> D' = 0).
Proof. simpl. rewrite denominator_scaled. apply positive_sign, factor_pos. Qed.

(** T and D of a plane through p with normal n; a triangle's are those of its own plane. *)
Definition T_of (r : ray) (p n : vec) := dot (vsub p (origin r)) n.
Definition D_of (r : ray) (n : vec) := dot (direction r) n.
Lemma plane_scaled o d p n k :
  T_of (float_ray o d) (scaled unit p) (scaled k n) = L * bpow radix2 k * T_of (real_ray o d) (real p) (real n)
  /\ D_of (float_ray o d) (scaled k n) = M * bpow radix2 k * D_of (real_ray o d) (real n).
Proof.
  split; unfold T_of, D_of, float_ray, real_ray, scaled, dot, vsub, vscale; simpl; ring.
Qed.

(** t = T / D 2^shift. *)
Definition shift := (unit - direction_unit)%Z.
Theorem depth_scaled o d a b c :
  denominator (real_ray o d) (real_triangle a b c) <> 0 ->
  depth (float_ray o d) (float_triangle a b c) =
  depth (real_ray o d) (real_triangle a b c) * bpow radix2 shift.
Proof.
  intros H. unfold depth. rewrite numerator_scaled, denominator_scaled.
  unfold shift, Z.sub. rewrite bpow_plus, bpow_opp. generalize (bpow_gt_0 radix2 unit) (bpow_gt_0 radix2 direction_unit).
  intros. field. repeat split; lra.
Qed.
Theorem plane_depth_scaled o d p n k : D_of (real_ray o d) (real n) <> 0 ->
  T_of (float_ray o d) (scaled unit p) (scaled k n) / D_of (float_ray o d) (scaled k n) =
  T_of (real_ray o d) (real p) (real n) / D_of (real_ray o d) (real n) * bpow radix2 shift.
Proof.
  intros H. destruct (plane_scaled o d p n k) as [-> ->].
  unfold shift, Z.sub. rewrite bpow_plus, bpow_opp.
  generalize (bpow_gt_0 radix2 unit) (bpow_gt_0 radix2 direction_unit) (bpow_gt_0 radix2 k).
  intros. field. repeat split; lra.
Qed.

(** Two hits of one ray are in the order of their integers' T / D: all are scaled by 2^shift. With
    [gap_sign] this is the sign of T1 D2 - T2 D1, turned where D1 and D2 have different signs. *)
Theorem order_scaled t1 t2 : t1 * bpow radix2 shift < t2 * bpow radix2 shift <-> t1 < t2.
Proof. generalize (bpow_gt_0 radix2 shift). intros; split; intros; nra. Qed.
End Scales.

Definition gap (first second : Hit) : Z :=
  let gap := (numerator_ first * denominator_ second - numerator_ second * denominator_ first)%Z in
  if Bool.eqb (0 <? denominator_ first)%Z (0 <? denominator_ second)%Z then gap else (- gap)%Z.
Definition ratio (h : Hit) : R := IZR (numerator_ h) / IZR (denominator_ h).
Theorem gap_sign h1 h2 : denominator_ h1 <> 0%Z -> denominator_ h2 <> 0%Z ->
  exists k, 0 < k /\ IZR (gap h1 h2) = k * (ratio h1 - ratio h2).
Proof.
  destruct h1 as [T1 D1 ? ? ? ? ?], h2 as [T2 D2 ? ? ? ? ?]. unfold gap, ratio; simpl. intros N1 N2.
  assert (R1 : IZR D1 <> 0) by now apply not_0_IZR.
  assert (R2 : IZR D2 <> 0) by now apply not_0_IZR.
  destruct (Z.ltb_spec 0 D1) as [P1|P1], (Z.ltb_spec 0 D2) as [P2|P2]; simpl;
    [exists (IZR D1 * IZR D2) | exists (- (IZR D1 * IZR D2)) | exists (- (IZR D1 * IZR D2))
     | exists (IZR D1 * IZR D2)];
    (split; [| rewrite ?opp_IZR, minus_IZR, !mult_IZR; field; auto]).
  1: apply IZR_lt in P1, P2; nra.
  all: try (assert (Q1 : (D1 < 0)%Z) by lia; apply IZR_lt in Q1).
  all: try (assert (Q2 : (D2 < 0)%Z) by lia; apply IZR_lt in Q2).
  all: try apply IZR_lt in P1; try apply IZR_lt in P2; nra.
Qed.
