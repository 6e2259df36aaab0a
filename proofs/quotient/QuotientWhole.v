(** Where the recorded test says so, the recorded t is T / D of real numbers, rounded once.

    The recorded stages of [quotient.py] ([QuotientCode.v]), put together: each one's results are
    the next one's variables. A surface is a triangle or an infinite plane; the ray is exact. In
    three cases: all rays share their origin, or their direction, or nothing. All is as if there
    were no largest float, and [no_inf] says that no e is inf; [QuotientBinary.v] says why that is
    enough. *)
Require Import ZArith Reals Psatz String List Bool.
From Reftrace Require Import Trees Rounding Digits ScalarProduct CrossProduct Ziv Quotient QuotientCode.
From Reftrace Require RecordedQuotient Geometry.
From Flocq Require Import Core.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.

(** ** Variables by name *)

Fixpoint find (l : list (string * R)) (name : string) : R :=
  match l with
  | [] => 0
  | (known, x) :: rest => if String.eqb known name then x else find rest name
  end.
Definition stage (l : list (string * R)) : renv := REnv (find l) (fun _ => false).
Definition xyz (name : string) (v : vec) : list (string * R) :=
  [(name ++ "x", px v); (name ++ "y", py v); (name ++ "z", pz v)].

(** ** Surfaces, and what [Quotients.of] hands on of them: n as a sum, M, and a point *)

Inductive surface := Corners (s : Geometry.triangle) | Plane (point normal : Geometry.vec).

Definition T0 (r : Geometry.ray) (s : surface) : R :=
  match s with
  | Corners s => Geometry.numerator r s
  | Plane point normal => Geometry.dot (Geometry.vsub point (Geometry.origin r)) normal
  end.
Definition D0 (r : Geometry.ray) (s : surface) : R :=
  match s with
  | Corners s => Geometry.denominator r s
  | Plane point normal => Geometry.dot (Geometry.direction r) normal
  end.

Definition real (v : Geometry.vec) : vec := Vec (Geometry.vx v) (Geometry.vy v) (Geometry.vz v).
Definition all_floats (v : Geometry.vec) : Prop := floats (real v).
Definition float_ray (r : Geometry.ray) : Prop :=
  all_floats (Geometry.origin r) /\ all_floats (Geometry.direction r).
Definition float_surface (s : surface) : Prop :=
  match s with
  | Corners s => all_floats (Geometry.ca s) /\ all_floats (Geometry.cb s) /\ all_floats (Geometry.cc s)
  | Plane point normal => all_floats point /\ all_floats normal
  end.

Definition corners (s : Geometry.triangle) : renv :=
  stage (xyz "a" (real (Geometry.ca s)) ++ xyz "b" (real (Geometry.cb s)) ++ xyz "c" (real (Geometry.cc s))).
Definition high_normal (s : surface) : vec :=
  match s with Corners s => recorded_normal (corners s) | Plane _ normal => real normal end.
Definition low_normal (s : surface) : vec :=
  match s with Corners s => recorded_normal_low (corners s) | Plane _ _ => zero end.
Definition normal_error (s : surface) : R :=
  match s with Corners s => fl (corners s) RecordedQuotient.normal_M | Plane _ _ => 0 end.
Definition point_of (s : surface) : vec :=
  match s with Corners s => real (Geometry.ca s) | Plane point _ => real point end.
Definition finite_error (s : surface) : Prop :=
  match s with Corners s => no_inf (corners s) RecordedQuotient.normal_M = true | Plane _ _ => True end.
Definition exact_normal (s : surface) : vec :=
  match s with Corners s => real (Geometry.normal s) | Plane _ normal => real normal end.

Theorem surface_known s : float_surface s -> finite_error s ->
  known (exact_normal s) (high_normal s) (low_normal s) (normal_error s).
Proof.
  destruct s as [[a b c]|p n]; intros F N; [|exact (plane_known _ (proj2 F))].
  destruct F as [A [B C]]. cbn [Geometry.ca Geometry.cb Geometry.cc] in A, B, C.
  destruct (normal_code _ N) as [E L].
  change (vector _ "a") with (real a) in E. change (vector _ "b") with (real b) in E.
  change (vector _ "c") with (real c) in E.
  generalize (triangle_known _ _ _ A B C). rewrite <- E. intros K. exact (K L).
Qed.

Lemma point_floats s : float_surface s -> floats (point_of s).
Proof. destruct s as [s|p n]; intros F; apply F. Qed.
Lemma T0_inner r s : T0 r s = inner (minus (point_of s) (real (Geometry.origin r))) (exact_normal s).
Proof. now destruct s. Qed.
Lemma D0_inner r s : D0 r s = inner (real (Geometry.direction r)) (exact_normal s).
Proof. now destruct s. Qed.

(** ** The stages *)

(** What [_enter] sees; [origin] is the first ray's. *)
Definition entered (s : surface) (origin direction : vec) (unit : R) : renv :=
  stage (xyz "n" (high_normal s) ++ xyz "n2" (low_normal s) ++ xyz "p" (point_of s) ++
    xyz "o" origin ++ xyz "d" direction ++ [("M", normal_error s); ("unit", unit)]).

Lemma entered_is s o d unit : let v := entered s o d unit in
  (vector v "n" = high_normal s /\ vector v "n2" = low_normal s /\ vector v "p" = point_of s /\
   vector v "o" = o /\ vector v "d" = d) /\ var v "M" = normal_error s /\ var v "unit" = unit.
Proof.
  unfold entered. destruct (high_normal s), (low_normal s), (point_of s), o, d. repeat split.
Qed.

(** What [_quotient] sees, of what [meet] calls it with. *)
Definition called (v : renv) (T1 T2 ET D1 D2 ED : expr) : renv :=
  stage [("T1", fl v T1); ("T2", fl v T2); ("ET", fl v ET); ("D1", fl v D1);
    ("D2", fl v D2); ("ED", fl v ED)].

Lemma called_code v T1 T2 ET D1 D2 ED result : let q := called v T1 T2 ET D1 D2 ED in
  quotient (fl v T1) (fl v T2) (fl v ET) (fl v D1) (fl v D2) (fl v ED) = result ->
  fl q RecordedQuotient.quotient_t = fst result /\ truth rnd q RecordedQuotient.quotient_sure = snd result.
Proof. intros q <-. assert (E := quotient_code q). now injection E. Qed.

(** *** From one origin *)

(** Of several rays [__init__] takes the largest |d|, by component. *)
Definition unit_of_directions (most : vec) : R := fl (stage (xyz "d" most)) RecordedQuotient.unit_from_point.

Definition column_from_point (s : surface) (origin : vec) (unit : R) : renv := entered s origin zero unit.
Definition meeting_from_point (s : surface) (origin direction : vec) (unit : R) : renv :=
  let t := column_from_point s origin unit in
  let high := fl3 t RecordedQuotient.table_from_point_hx RecordedQuotient.table_from_point_hy RecordedQuotient.table_from_point_hz in
  let low := fl3 t RecordedQuotient.table_from_point_lx RecordedQuotient.table_from_point_ly RecordedQuotient.table_from_point_lz in
  stage (xyz "h" high ++ xyz "l" low ++ xyz "d" direction ++ [
    ("T1", fl t RecordedQuotient.table_from_point_T1); ("T2", fl t RecordedQuotient.table_from_point_T2);
    ("ET", fl t RecordedQuotient.table_from_point_ET); ("ED", fl t RecordedQuotient.table_from_point_ED); ("unit", unit)]).
Definition met_from_point (s : surface) (origin direction : vec) (unit : R) : renv :=
  called (meeting_from_point s origin direction unit)
    RecordedQuotient.meet_from_point_T1 RecordedQuotient.meet_from_point_T2 RecordedQuotient.meet_from_point_ET
    RecordedQuotient.meet_from_point_D1 RecordedQuotient.meet_from_point_D2 RecordedQuotient.meet_from_point_ED.

Definition finite_from_point (s : surface) (origin : vec) (unit : R) : Prop := finite_error s /\
  no_inf (column_from_point s origin unit) RecordedQuotient.table_from_point_ET = true /\
  no_inf (column_from_point s origin unit) RecordedQuotient.table_from_point_ED = true.

Lemma from_point_is s o d unit : finite_from_point s o unit ->
  let q := met_from_point s o d unit in let n := high_normal s in let size := size_of n (normal_error s) in
  let result := meet_origin n (low_normal s) (normal_error s) unit o d (point_of s) in
  (fl q RecordedQuotient.quotient_t = fst result /\ truth rnd q RecordedQuotient.quotient_sure = snd result) /\
  in_range (power_above (sums (point_of s) o)) size /\ in_range unit size.
Proof.
  intros [_ [ET ED]]. set (t := column_from_point s o unit) in *.
  destruct (entered_is s o zero unit) as [[N [M [P [O _]]]] [ME UE]].
  fold (column_from_point s o unit) in N, M, P, O, ME, UE. fold t in N, M, P, O, ME, UE.
  apply table_from_point_ET in ET. apply table_from_point_ED in ED.
  destruct (table_from_point_halves t) as [H L].
  destruct (split_pair _ _ _ (table_from_point_T t)) as [E1 E2].
  unfold high_of, low_of, table_T in *. rewrite N, ?M, ?P, ?O, ?ME, ?UE in *.
  destruct ET as [R1 ET], ED as [R2 ED].
  split; [|split; assumption]. unfold met_from_point, meeting_from_point. fold t. cbv zeta. apply called_code.
  set (v := stage _). destruct (split_pair _ _ _ (meet_from_point_D v)) as [D1 D2].
  destruct (meet_from_point_T v) as [-> [-> [-> ->]]]. rewrite D1, D2.
  change (var v "T1") with (fl t RecordedQuotient.table_from_point_T1). rewrite E1.
  change (var v "T2") with (fl t RecordedQuotient.table_from_point_T2). rewrite E2.
  change (var v "ET") with (fl t RecordedQuotient.table_from_point_ET). rewrite ET.
  change (var v "ED") with (fl t RecordedQuotient.table_from_point_ED). rewrite ED.
  change (var v "unit") with unit.
  replace (vector v "h") with (high_half (power_above (high_normal s)) (high_normal s)) by now rewrite <- H.
  replace (vector v "l") with (low_half (power_above (high_normal s)) (high_normal s) (low_normal s))
    by now rewrite <- L.
  replace (vector v "d") with d by now destruct d.
  reflexivity.
Qed.

Definition within_of (v most : vec) : Prop :=
  Rabs (px v) <= Rabs (px most) /\ Rabs (py v) <= Rabs (py most) /\ Rabs (pz v) <= Rabs (pz most).

Theorem recorded_from_point (s : surface) (r : Geometry.ray) (most : vec) :
  float_surface s -> float_ray r -> within_of (real (Geometry.direction r)) most ->
  let o := real (Geometry.origin r) in let d := real (Geometry.direction r) in
  let unit := unit_of_directions most in
  finite_from_point s o unit ->
  let v := met_from_point s o d unit in
  truth rnd v RecordedQuotient.quotient_sure = true ->
  D0 r s <> 0 /\ fl v RecordedQuotient.quotient_t = rnd (T0 r s / D0 r s).
Proof.
  intros FS [FO FD] W o d unit F v Q. destruct (from_point_is s o d unit F) as [[E1 E2] [R1 R2]].
  fold v in E1, E2. rewrite E1, T0_inner, D0_inner. rewrite E2 in Q.
  apply meet_origin_correct; auto.
  - apply surface_known; [exact FS | apply F].
  - now apply point_floats.
  - exists most. split; [|exact W]. unfold unit, unit_of_directions.
    rewrite unit_from_point_code. now destruct most.
Qed.

(** *** Along one direction *)

(** The rays' origins, less the first of them, as floats; of those the largest, by component. *)
Definition apart (v w : vec) : vec := map2 (fun x y => rnd (x - y)) v w.
Definition unit_of_origins (most : vec) : R := fl (stage (xyz "v" most)) RecordedQuotient.power_above.

Definition column_parallel (s : surface) (first direction : vec) (unit : R) : renv :=
  entered s first direction unit.
Definition meeting_parallel (s : surface) (first origin direction : vec) (unit : R) : renv :=
  let t := column_parallel s first direction unit in
  let high := fl3 t RecordedQuotient.table_parallel_hx RecordedQuotient.table_parallel_hy RecordedQuotient.table_parallel_hz in
  let low := fl3 t RecordedQuotient.table_parallel_lx RecordedQuotient.table_parallel_ly RecordedQuotient.table_parallel_lz in
  stage (xyz "h" high ++ xyz "l" low ++ xyz "q" origin ++ xyz "o" first ++ [
    ("T1", fl t RecordedQuotient.table_parallel_T1); ("T2", fl t RecordedQuotient.table_parallel_T2);
    ("ET", fl t RecordedQuotient.table_parallel_ET); ("D1", fl t RecordedQuotient.table_parallel_D1);
    ("D2", fl t RecordedQuotient.table_parallel_D2); ("ED", fl t RecordedQuotient.table_parallel_ED); ("unit", unit)]).
Definition met_parallel (s : surface) (first origin direction : vec) (unit : R) : renv :=
  called (meeting_parallel s first origin direction unit)
    RecordedQuotient.meet_parallel_T1 RecordedQuotient.meet_parallel_T2 RecordedQuotient.meet_parallel_ET
    RecordedQuotient.meet_parallel_D1 RecordedQuotient.meet_parallel_D2 RecordedQuotient.meet_parallel_ED.

Definition finite_parallel (s : surface) (first direction : vec) (unit : R) : Prop := finite_error s /\
  no_inf (column_parallel s first direction unit) RecordedQuotient.table_parallel_ET = true /\
  no_inf (column_parallel s first direction unit) RecordedQuotient.table_parallel_ED = true.

Lemma parallel_is s f o d unit : finite_parallel s f d unit ->
  let q := met_parallel s f o d unit in let n := high_normal s in let size := size_of n (normal_error s) in
  let result := meet_direction n (low_normal s) (normal_error s) unit f o d (point_of s) in
  (fl q RecordedQuotient.quotient_t = fst result /\ truth rnd q RecordedQuotient.quotient_sure = snd result) /\
  in_range (power_above (sums (point_of s) f)) size /\ in_range unit size /\ in_range (power_above d) size.
Proof.
  intros [_ [ET ED]]. set (t := column_parallel s f d unit) in *.
  destruct (entered_is s f d unit) as [[N [M [P [O D]]]] [ME UE]].
  fold (column_parallel s f d unit) in N, M, P, O, D, ME, UE. fold t in N, M, P, O, D, ME, UE.
  apply table_parallel_ET in ET. apply table_parallel_ED in ED.
  destruct (table_parallel_halves t) as [H L].
  destruct (split_pair _ _ _ (table_parallel_T t)) as [E1 E2].
  destruct (split_pair _ _ _ (table_parallel_D t)) as [D1 D2].
  unfold high_of, low_of, table_T in *. rewrite N, ?M, ?P, ?O, ?D, ?ME, ?UE in *.
  destruct ET as [[R1 R2] ET], ED as [R3 ED].
  split; [|split; [exact R1 | now split]]. unfold met_parallel, meeting_parallel.
  fold t. cbv zeta. apply called_code.
  set (v := stage _). destruct (split_pair _ _ _ (meet_parallel_T v)) as [T1 T2].
  cbv zeta in T1, T2. cbn [fst snd] in T1, T2.
  destruct (meet_parallel_rest v) as [-> [-> [-> ->]]]. rewrite T1, T2.
  change (var v "T1") with (fl t RecordedQuotient.table_parallel_T1). rewrite E1.
  change (var v "T2") with (fl t RecordedQuotient.table_parallel_T2). rewrite E2.
  change (var v "ET") with (fl t RecordedQuotient.table_parallel_ET). rewrite ET.
  change (var v "D1") with (fl t RecordedQuotient.table_parallel_D1). rewrite D1.
  change (var v "D2") with (fl t RecordedQuotient.table_parallel_D2). rewrite D2.
  change (var v "ED") with (fl t RecordedQuotient.table_parallel_ED). rewrite ED.
  change (var v "unit") with unit.
  replace (vector v "h") with (high_half (power_above (high_normal s)) (high_normal s)) by now rewrite <- H.
  replace (vector v "l") with (low_half (power_above (high_normal s)) (high_normal s) (low_normal s))
    by now rewrite <- L.
  replace (vector v "q") with o by (unfold v; now destruct o).
  replace (vector v "o") with f by (unfold v; now destruct f).
  unfold meet_direction, prepared_dot. cbv zeta. reflexivity.
Qed.

Theorem recorded_parallel (s : surface) (r : Geometry.ray) (first : Geometry.vec) (most : vec) :
  float_surface s -> float_ray r -> all_floats first ->
  within_of (apart (real (Geometry.origin r)) (real first)) most ->
  let f := real first in let o := real (Geometry.origin r) in let d := real (Geometry.direction r) in
  let unit := unit_of_origins most in
  finite_parallel s f d unit ->
  let v := met_parallel s f o d unit in
  truth rnd v RecordedQuotient.quotient_sure = true ->
  D0 r s <> 0 /\ fl v RecordedQuotient.quotient_t = rnd (T0 r s / D0 r s).
Proof.
  intros FS [FO FD] FF W f o d unit F v Q. destruct (parallel_is s f o d unit F) as [[E1 E2] [R1 [R2 R3]]].
  fold v in E1, E2. rewrite E1, T0_inner, D0_inner. rewrite E2 in Q.
  apply meet_direction_correct; auto.
  - apply surface_known; [exact FS | apply F].
  - now apply point_floats.
  - exists most. split; [|exact W]. unfold unit, unit_of_origins. rewrite power_above_code. now destruct most.
Qed.

(** *** Rays that share nothing *)

Definition column_alone (s : surface) : renv := entered s zero zero 0.
Definition meeting_alone (s : surface) (origin direction : vec) : renv :=
  let t := column_alone s in
  let high := fl3 t RecordedQuotient.table_alone_hx RecordedQuotient.table_alone_hy RecordedQuotient.table_alone_hz in
  let low := fl3 t RecordedQuotient.table_alone_lx RecordedQuotient.table_alone_ly RecordedQuotient.table_alone_lz in
  let point := fl3 t RecordedQuotient.table_alone_px RecordedQuotient.table_alone_py RecordedQuotient.table_alone_pz in
  stage (xyz "h" high ++ xyz "l" low ++ xyz "p" point ++ xyz "o" origin ++ xyz "d" direction ++ [
    ("size", fl t RecordedQuotient.table_alone_size)]).
Definition met_alone (s : surface) (origin direction : vec) : renv :=
  called (meeting_alone s origin direction)
    RecordedQuotient.meet_alone_T1 RecordedQuotient.meet_alone_T2 RecordedQuotient.meet_alone_ET
    RecordedQuotient.meet_alone_D1 RecordedQuotient.meet_alone_D2 RecordedQuotient.meet_alone_ED.

Definition finite_alone (s : surface) (origin direction : vec) : Prop := finite_error s /\
  no_inf (meeting_alone s origin direction) RecordedQuotient.meet_alone_ET = true /\
  no_inf (meeting_alone s origin direction) RecordedQuotient.meet_alone_ED = true.

Lemma alone_is s o d : finite_alone s o d ->
  let q := met_alone s o d in let n := high_normal s in let size := size_of n (normal_error s) in
  let result := meet_apart n (low_normal s) (normal_error s) o d (point_of s) in
  (fl q RecordedQuotient.quotient_t = fst result /\ truth rnd q RecordedQuotient.quotient_sure = snd result) /\
  in_range (power_above (sums (point_of s) o)) size /\ in_range (power_above d) size.
Proof.
  intros [_ [ET ED]]. apply meet_alone_ET in ET. apply meet_alone_ED in ED.
  unfold met_alone. set (v := meeting_alone s o d) in *. set (t := column_alone s).
  destruct (entered_is s zero zero 0) as [[N [M [P _]]] [ME _]].
  fold (column_alone s) in N, M, P, ME. fold t in N, M, P, ME.
  destruct (table_alone_halves t) as [H L]. assert (S := table_alone_size t). assert (C := table_alone_p t).
  destruct (split_pair _ _ _ (meet_alone_T v)) as [T1 T2].
  destruct (split_pair _ _ _ (meet_alone_D v)) as [D1 D2].
  unfold high_of, low_of in *. rewrite ?N, ?M, ?P, ?ME in *.
  replace (vector v "p") with (point_of s) in * by now rewrite <- C.
  replace (vector v "o") with o in * by now destruct o.
  replace (vector v "d") with d in * by now destruct d.
  replace (vector v "h") with (high_half (power_above (high_normal s)) (high_normal s)) in *
    by now rewrite <- H.
  replace (vector v "l") with (low_half (power_above (high_normal s)) (high_normal s) (low_normal s)) in *
    by now rewrite <- L.
  replace (var v "size") with (size_of (high_normal s) (normal_error s)) in * by now rewrite <- S.
  destruct ET as [R1 ET], ED as [R2 ED]. split; [|split; assumption]. cbv zeta. apply called_code.
  rewrite T1, T2, D1, D2, ET, ED. reflexivity.
Qed.

Theorem recorded_alone (s : surface) (r : Geometry.ray) :
  float_surface s -> float_ray r ->
  let o := real (Geometry.origin r) in let d := real (Geometry.direction r) in
  finite_alone s o d ->
  let v := met_alone s o d in
  truth rnd v RecordedQuotient.quotient_sure = true ->
  D0 r s <> 0 /\ fl v RecordedQuotient.quotient_t = rnd (T0 r s / D0 r s).
Proof.
  intros FS [FO FD] o d F v Q. destruct (alone_is s o d F) as [[E1 E2] [R1 R2]].
  fold v in E1, E2. rewrite E1, T0_inner, D0_inner. rewrite E2 in Q.
  apply meet_apart_correct; auto.
  - apply surface_known; [exact FS | apply F].
  - now apply point_floats.
Qed.
