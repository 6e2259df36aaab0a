(** What [code_answers] says in binary64 of one surface: possible, sure, and the interval of t. *)
Require Import ZArith Reals Psatz List String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees Rounding Magnitude Signs Forms Interval IntervalCode
  RecordedBounds Pairs.
From Reftrace Require Import CodeAnswers.
From Reftrace Require Contest Facts.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.

Section Floats.
Variable i : inputs.
Hypothesis origin_finite : finite (ray_origin i).
Hypothesis direction_finite : finite (ray_direction i).
Hypothesis one_of : one_of_the_rays i.
Notation r := (stored_ray i).

(** ** The bounds are for this ray, too *)

Lemma reach_above s : match shared i with ParallelRays _ _ _ => False | _ => True end ->
  within_reach (of_pair i s).
Proof.
  intros K. unfold one_of_the_rays in one_of. unfold of_pair, of_kind.
  assert (A : forall x y : float, is_finite x = true -> is_finite y = true ->
    at_most_in_size x y -> above y x).
  { intros x y Fx _ [L S]. split; [now right|]. auto. }
  destruct direction_finite as [Fx [Fy Fz]].
  destruct (shared i) as [reach| |]; [|easy|]; destruct s; repeat split; cbn;
    try (apply not_negative_abs); try (rewrite ?is_finite_Babs, ?B2R_Babs; auto with real; fail);
    destruct one_of as [[Rx [Ry Rz]] [X [Y Z]]];
    first [apply (proj1 (A _ _ Fx Rx X)) | apply (proj1 (A _ _ Fy Ry Y)) | apply (proj1 (A _ _ Fz Rz Z))
          | intros; auto; first [apply X | apply Y | apply Z]].
Qed.

Lemma box_around s : match shared i with ParallelRays _ _ _ => True | _ => False end ->
  within_box (of_pair i s).
Proof.
  intros K. unfold one_of_the_rays in one_of. unfold of_pair, of_kind.
  destruct (shared i) as [|low high first|]; try easy.
  destruct one_of as [[Lx [Ly Lz]] [[Hx [Hy Hz]] [_ [[X [Y Z]] [X' [Y' Z']]]]]].
  destruct origin_finite as [Ox [Oy Oz]].
  destruct s; repeat split; cbn; assumption.
Qed.

(** ** [sides] *)

Lemma sides_bounds s : exists E e1 e2 e3,
  sides_env i s = of_sides (of_pair i s) E e1 e2 e3 /\
  bounds (of_pair i s) E e1 /\ bounds (of_pair i s) E e2 /\ bounds (of_pair i s) E e3 /\
  let v := of_pair i s in
  ex (real_env v) e1 = edge (real_ray v) (real_vec v "a") (real_vec v "b") /\
  ex (real_env v) e2 = edge (real_ray v) (real_vec v "b") (real_vec v "c") /\
  ex (real_env v) e3 = edge (real_ray v) (real_vec v "c") (real_vec v "a").
Proof.
  destruct recorded_from_point as [P1 [P2 [P3 [PE _]]]].
  destruct recorded_parallel as [Q1 [Q2 [Q3 [QE _]]]].
  unfold sides_env. assert (W := reach_above s). assert (W' := box_around s).
  assert (FP : within_reach (of_pair i s) -> exists E e1 e2 e3,
    of_sides (of_pair i s) from_point_error from_point_ab from_point_bc from_point_ca =
      of_sides (of_pair i s) E e1 e2 e3 /\
    bounds (of_pair i s) E e1 /\ bounds (of_pair i s) E e2 /\ bounds (of_pair i s) E e3 /\
    let v := of_pair i s in
    ex (real_env v) e1 = edge (real_ray v) (real_vec v "a") (real_vec v "b") /\
    ex (real_env v) e2 = edge (real_ray v) (real_vec v "b") (real_vec v "c") /\
    ex (real_env v) e3 = edge (real_ray v) (real_vec v "c") (real_vec v "a")).
  { intros R. rewrite P1, P2, P3, PE. destruct (from_point_e _ R) as [B1 [B2 B3]].
    do 4 eexists. split; [reflexivity|]. split; [exact B1|]. split; [exact B2|]. split; [exact B3|].
    apply exact_from_point. }
  destruct (shared i) as [reach|low high first|]; [exact (FP (W I)) | | exact (FP (W I))].
  rewrite Q1, Q2, Q3, QE. destruct (parallel_e _ (W' I)) as [B1 [B2 B3]].
  do 4 eexists. split; [reflexivity|]. split; [exact B1|]. split; [exact B2|]. split; [exact B3|].
  apply exact_parallel.
Qed.

Lemma ray_of_pair s : real_ray (of_pair i s) = r.
Proof. destruct s; reflexivity. Qed.
Lemma corners_of_pair a b c : let v := of_pair i (StoredTriangle a b c) in
  real_vec v "a" = reals a /\ real_vec v "b" = reals b /\ real_vec v "c" = reals c.
Proof. repeat split; reflexivity. Qed.
Lemma plane_of_pair p n : let v := of_pair i (StoredPlane p n) in
  real_vec v "p" = reals p /\ real_vec v "n" = reals n.
Proof. repeat split; reflexivity. Qed.

Theorem code_impossible s : is_stored i s -> code_possible i s = false -> ~ Contest.meets_closed r s.
Proof.
  intros [_ S] H. unfold code_possible in H. unfold Contest.meets_closed. rewrite S.
  destruct (floats_of i s) as [a b c|]; [|discriminate]. cbn [shape_stored].
  destruct (sides_bounds (StoredTriangle a b c)) as (E & e1 & e2 & e3 & V & B1 & B2 & B3 & X1 & X2 & X3).
  rewrite V in H. apply sides_impossible_right in H; auto.
  destruct (corners_of_pair a b c) as [A [B C]]. rewrite X1, X2, X3, A, B, C, ray_of_pair in H.
  unfold meets. cbn [ca cb cc]. lra.
Qed.

Theorem code_surely s : is_stored i s -> code_sure i s = true ->
  match Contest.shape_of s with Contest.Triangular x => meets_inside r x | Contest.Infinite _ _ => True end.
Proof.
  intros [_ S] H. unfold code_sure in H. rewrite S.
  destruct (floats_of i s) as [a b c|]; [|easy]. cbn [shape_stored].
  destruct (sides_bounds (StoredTriangle a b c)) as (E & e1 & e2 & e3 & V & B1 & B2 & B3 & X1 & X2 & X3).
  rewrite V in H. apply sides_sure_right in H; auto.
  destruct (corners_of_pair a b c) as [A [B C]]. rewrite X1, X2, X3, A, B, C, ray_of_pair in H.
  unfold meets_inside. cbn [ca cb cc]. exact H.
Qed.

(** ** [Fractions.interval] *)

Lemma interval_bounds s : is_stored i s -> exists T ET D ED,
  interval_env i (floats_of i s) = of_interval (of_pair i (floats_of i s)) T ET D ED /\
  bounds (of_pair i (floats_of i s)) ET T /\ bounds (of_pair i (floats_of i s)) ED D /\
  ex (real_env (of_pair i (floats_of i s))) T = Contest.T r s /\
  ex (real_env (of_pair i (floats_of i s))) D = Contest.D r s.
Proof.
  intros [_ S]. unfold Contest.T, Contest.D. rewrite S. unfold interval_env.
  destruct (floats_of i s) as [a b c|p n]; cbn [shape_stored].
  - set (v := of_pair i (StoredTriangle a b c)).
    assert (ET : ex (real_env v) T_of = numerator r (Triangle (reals a) (reals b) (reals c))) by apply
      exact_T.
    assert (ED : ex (real_env v) D_of = denominator r (Triangle (reals a) (reals b) (reals c))) by apply
      exact_D.
    destruct recorded_from_point as [_ [_ [_ [_ [P1 [P2 [P3 P4]]]]]]].
    destruct recorded_parallel as [_ [_ [_ [_ [Q1 [Q2 [Q3 Q4]]]]]]].
    assert (W := reach_above (StoredTriangle a b c)). assert (W' := box_around (StoredTriangle a b c)).
    rewrite P1, P2, P3, P4, Q1, Q2, Q3, Q4. destruct (shared i) as [reach|low high first|].
    + exists T_of, E_T_from_point, D_of, E_D_from_point. split; [reflexivity|].
      split; [apply Forms.from_point_T|]. split; [now apply Forms.from_point_D, W|]. auto.
    + exists T_of, E_T_parallel, D_of, E_D_parallel. split; [reflexivity|].
      split; [now apply Forms.parallel_T, W'|]. split; [apply Forms.parallel_D|]. auto.
    + exists T_of, E_T_from_point, D_of, E_D_from_point. split; [reflexivity|].
      split; [apply Forms.from_point_T|]. split; [now apply Forms.from_point_D, W|]. auto.
  - destruct recorded_plane as [P1 [P2 [P3 P4]]]. rewrite P1, P2, P3, P4.
    do 4 eexists. split; [reflexivity|]. split; [apply Forms.plane_T|]. split; [apply Forms.plane_D|].
    rewrite exact_T_plane, exact_D_plane. split; reflexivity.
Qed.

Lemma number_of_finite x : is_finite x = true -> number_of x = Contest.Finite (B2R x).
Proof. destruct x; simpl; intros; try discriminate; reflexivity. Qed.
Lemma finite_number_of x : Contest.is_finite (number_of x) = is_finite x.
Proof. now destruct x as [|[]| |]. Qed.
Lemma number_of_float x h : number_of x = Contest.Finite h -> is_finite x = true /\ B2R x = h.
Proof. destruct x as [|[]| |]; simpl; intros [= <-]; auto. Qed.

Theorem code_interval_above s h : is_stored i s -> number_of (high_float i s) = Contest.Finite h ->
  Facts.float64 h /\ Contest.D r s <> 0 /\ Contest.t r s <= h.
Proof.
  intros S H. destruct (interval_bounds s S) as (T & ET & D & ED & V & BT & BD & XT & XD).
  unfold high_float in H. rewrite V in H. apply number_of_float in H. destruct H as [F <-].
  destruct (interval_right _ T ET D ED BT BD) as [_ [U _]]. destruct (U F) as [N L].
  rewrite XT, XD in L. rewrite XD in N. split; [|split]; auto. eexists; split; [exact F|reflexivity].
Qed.

Theorem code_interval_not_minus s : is_stored i s ->
  number_of (high_float i s) <> Contest.MinusInfinity.
Proof.
  intros S H. destruct (interval_bounds s S) as (T & ET & D & ED & V & BT & BD & XT & XD).
  unfold high_float in H. rewrite V in H.
  destruct (interval_right _ T ET D ED BT BD) as [[U _] _]. apply U. cbv zeta.
  destruct (eval _ RecordedBounds.interval_high) as [|[]| |]; try discriminate H. reflexivity.
Qed.

Theorem code_interval_below s : is_stored i s -> Contest.D r s <> 0 ->
  0 <= Contest.t r s \/ Contest.is_finite (number_of (high_float i s)) = true ->
  Facts.at_most (number_of (low_float i s)) (Contest.t r s).
Proof.
  intros S N H. destruct (interval_bounds s S) as (T & ET & D & ED & V & BT & BD & XT & XD).
  unfold high_float in H. unfold low_float. rewrite V in *. rewrite finite_number_of in H.
  destruct (interval_right _ T ET D ED BT BD) as [_ [_ L]]. rewrite XT, XD in L. specialize (L N H).
  unfold Contest.t. revert L.
  generalize (eval (of_interval (of_pair i (floats_of i s)) T ET D ED) RecordedBounds.interval_low).
  intros x L. destruct x as [|[]| |]; cbn [number_of Facts.at_most low_end] in *; auto; [|easy].
  destruct L as [L|L]; [discriminate|]. intros f [y [Fy <-]].
  generalize (B2R_bounded y) (Rle_abs (B2R y)). lra.
Qed.

(** No end is NaN. *)
Lemma product_number x y : is_nan x = false -> is_finite_strict y = true -> is_nan (Bmult mode_NE x y :
  float) = false.
Proof.
  intros X Y. destruct (is_finite x) eqn:Fx.
  - assert (Fy : is_finite y = true) by (destruct y; auto).
    generalize (Bmult_correct prec emax _ _ mode_NE x y). case Rlt_bool_spec; intros _ H.
    + destruct H as [_ [F _]]. rewrite Fx, Fy in F. revert F. now generalize (Bmult mode_NE x y); intros [].
    + revert H. now generalize (Bmult mode_NE x y); intros [].
  - destruct x, y; simpl in *; try discriminate; reflexivity.
Qed.
Lemma minus_number x y : is_nan x = false -> is_finite y = true -> is_nan (Bminus mode_NE x y : float) =
  false.
Proof.
  intros X Y. destruct (is_finite x) eqn:Fx.
  - generalize (Bminus_correct prec emax _ _ mode_NE x y Fx Y). case Rlt_bool_spec; intros _ H.
    + destruct H as [_ [F _]]. revert F. now generalize (Bminus mode_NE x y); intros [].
    + revert H. now generalize (Bminus mode_NE x y); intros [].
  - destruct x, y; simpl in *; try discriminate; reflexivity.
Qed.

Theorem ends_are_numbers s : is_stored i s ->
  is_nan (low_float i s) = false /\ is_nan (high_float i s) = false.
Proof.
  intros S. destruct (interval_bounds s S) as (T & ET & D & ED & V & BT & BD & XT & XD).
  unfold high_float, low_float. rewrite V.
  split; [|apply (interval_right _ T ET D ED BT BD)].
  rewrite recorded_low. set (v := of_pair i (floats_of i s)) in *.
  destruct (holds v (known T ET D ED)) eqn:K.
  - destruct (known_interval v T ET D ED BT BD K) as [_ [L _]]. revert L.
    now generalize (eval v (interval_low_ T ET D ED)); intros [].
  - unfold interval_low_. cbn [eval]. rewrite K. unfold least. cbn [eval holds].
    destruct (Bcompare (eval v zero) (eval v (ratio T ET D ED))) as [[]|] eqn:C; try reflexivity.
    apply minus_number; [apply product_number|]; try reflexivity.
    revert C. generalize (eval v (ratio T ET D ED)). intros [] C; try reflexivity.
    exfalso. revert C. now destruct (eval v zero) as [[]|[]| |[]].
Qed.
End Floats.
