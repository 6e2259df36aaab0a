(** A camera's ray through any pixel, as recorded, is one of those that bounds are computed for. *)
Require Import ZArith Reals Psatz List String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Trees Rounding Magnitude RecordedCamera Pairs.
From Reftrace Require Import CodeAnswers AroundRays.
Open Scope R_scope.
Open Scope string_scope.

Lemma film_value (l w r b h u p q : float) :
  is_finite (Bplus mode_NE (Bmult mode_NE (Bplus mode_NE l (Bmult mode_NE p w)) r)
    (Bmult mode_NE (Bplus mode_NE b (Bmult mode_NE q h)) u) : float) = true ->
  is_finite p = true /\ is_finite q = true /\
  B2R (Bplus mode_NE (Bmult mode_NE (Bplus mode_NE l (Bmult mode_NE p w)) r)
    (Bmult mode_NE (Bplus mode_NE b (Bmult mode_NE q h)) u) : float) =
  rnd (part (B2R l) (B2R w) (B2R r) (B2R p) + part (B2R b) (B2R h) (B2R u) (B2R q)).
Proof.
  intros F. destruct (plus_finite _ _ F) as [F1 F2].
  destruct (mult_finite _ _ F1) as [F3 _]. destruct (mult_finite _ _ F2) as [F4 _].
  destruct (plus_finite _ _ F3) as [_ F5]. destruct (plus_finite _ _ F4) as [_ F6].
  destruct (mult_finite _ _ F5) as [Fp _]. destruct (mult_finite _ _ F6) as [Fq _].
  split; [exact Fp|]. split; [exact Fq|].
  rewrite (plus_value _ _ F), (mult_value _ _ F1), (mult_value _ _ F2), (plus_value _ _ F3), (plus_value _
    _ F4),
    (mult_value _ _ F5), (mult_value _ _ F6). reflexivity.
Qed.

Section Camera.
Variable camera : string -> float.
Definition pixel_width := eval (given camera) (Div (Sub (Var "right") (Var "left")) (Var "width")).
Definition pixel_height := eval (given camera) (Div (Sub (Var "top") (Var "bottom")) (Var "height")).

Lemma perspective_is r_ u_ f tree :
  (forall p q, eval (at_film camera p q) tree =
    Bplus mode_NE (Bplus mode_NE (Bmult mode_NE (Bplus mode_NE (camera "left") (Bmult mode_NE p
      pixel_width)) r_)
      (Bmult mode_NE (Bplus mode_NE (camera "bottom") (Bmult mode_NE q pixel_height)) u_)) f) ->
  forall p q, is_finite (eval (at_film camera p q) tree) = true -> is_finite p = true /\ is_finite q = true /\
  B2R (eval (at_film camera p q) tree) =
    component (B2R (camera "left")) (B2R pixel_width) (B2R r_) (B2R (camera "bottom")) (B2R pixel_height)
      (B2R u_)
      (fun x => rnd (x + B2R f)) (B2R p) (B2R q).
Proof.
  intros E p q. rewrite E. intros F. destruct (plus_finite _ _ F) as [F1 _].
  destruct (film_value _ _ _ _ _ _ _ _ F1) as [Fp [Fq V]]. split; [exact Fp|]. split; [exact Fq|].
  rewrite (plus_value _ _ F), V. reflexivity.
Qed.
Lemma parallel_is r_ u_ o tree :
  (forall p q, eval (at_film camera p q) tree =
    Bplus mode_NE o
      (Bplus mode_NE (Bmult mode_NE (Bplus mode_NE (camera "left") (Bmult mode_NE p pixel_width)) r_)
      (Bmult mode_NE (Bplus mode_NE (camera "bottom") (Bmult mode_NE q pixel_height)) u_))) ->
  forall p q, is_finite (eval (at_film camera p q) tree) = true -> is_finite p = true /\ is_finite q = true /\
  B2R (eval (at_film camera p q) tree) =
    component (B2R (camera "left")) (B2R pixel_width) (B2R r_) (B2R (camera "bottom")) (B2R pixel_height)
      (B2R u_)
      (fun x => rnd (B2R o + x)) (B2R p) (B2R q).
Proof.
  intros E p q. rewrite E. intros F. destruct (plus_finite _ _ F) as [_ F1].
  destruct (film_value _ _ _ _ _ _ _ _ F1) as [Fp [Fq V]]. split; [exact Fp|]. split; [exact Fq|].
  rewrite (plus_value _ _ F), V. reflexivity.
Qed.
Lemma rising_left f : rising (fun x => rnd (x + f)).
Proof. intros x y H. apply rnd_le. lra. Qed.
Lemma rising_right f : rising (fun x => rnd (f + x)).
Proof. intros x y H. apply rnd_le. lra. Qed.

(** Three recorded components, at a film position. *)
Definition three (x y z : expr) (p q : float) : floats :=
  F3 (eval (at_film camera p q) x) (eval (at_film camera p q) y) (eval (at_film camera p q) z).
Definition finite_at_corners (v : float -> float -> floats) : Prop :=
  finite (v (p0 camera) (q0 camera)) /\ finite (v (p0 camera) (q1 camera)) /\
  finite (v (p1 camera) (q0 camera)) /\ finite (v (p1 camera) (q1 camera)).
Notation this v := (v (film_p camera) (film_q camera)).

(** A perspective camera: directions. *)
Definition perspective_direction :=
  three ray_perspective_direction_x ray_perspective_direction_y ray_perspective_direction_z.
Theorem perspective_reach i :
  ray_direction i = this perspective_direction ->
  shared i = FromOnePoint (F3 (reach_of camera ray_perspective_direction_x)
    (reach_of camera ray_perspective_direction_y) (reach_of camera ray_perspective_direction_z)) ->
  finite_at_corners perspective_direction -> finite (this perspective_direction) -> in_picture camera ->
  one_of_the_rays i.
Proof.
  intros D S [[A0 [A1 A2]] [[B0 [B1 B2]] [[C0 [C1 C2]] [D0 [D1 D2]]]]] [E0 [E1 E2]] I.
  unfold one_of_the_rays. rewrite S, D.
  assert (X := reach_is camera ray_perspective_direction_x _ _ _ _ _ _ _ (rising_left _)
    (perspective_is (camera "rx") (camera "ux") (camera "fx") ray_perspective_direction_x
      (fun p q => eq_refl)) E0 A0 B0 C0 D0 I).
  assert (Y := reach_is camera ray_perspective_direction_y _ _ _ _ _ _ _ (rising_left _)
    (perspective_is (camera "ry") (camera "uy") (camera "fy") ray_perspective_direction_y
      (fun p q => eq_refl)) E1 A1 B1 C1 D1 I).
  assert (Z := reach_is camera ray_perspective_direction_z _ _ _ _ _ _ _ (rising_left _)
    (perspective_is (camera "rz") (camera "uz") (camera "fz") ray_perspective_direction_z
      (fun p q => eq_refl)) E2 A2 B2 C2 D2 I).
  split; [repeat split; [apply X | apply Y | apply Z]|]. split; [apply X|]. split; [apply Y | apply Z].
Qed.

(** An orthographic camera: origins. *)
Definition parallel_origin := three ray_parallel_origin_x ray_parallel_origin_y ray_parallel_origin_z.
Theorem parallel_box i :
  ray_origin i = this parallel_origin ->
  shared i = ParallelRays
    (F3 (low_of camera ray_parallel_origin_x) (low_of camera ray_parallel_origin_y)
      (low_of camera ray_parallel_origin_z))
    (F3 (high_of camera ray_parallel_origin_x) (high_of camera ray_parallel_origin_y)
      (high_of camera ray_parallel_origin_z))
    (parallel_origin (p0 camera) (q0 camera)) ->
  finite_at_corners parallel_origin -> finite (this parallel_origin) -> in_picture camera ->
  one_of_the_rays i.
Proof.
  intros D S [A [B [C G]]] E I. unfold one_of_the_rays. rewrite S, D.
  assert (Fa := A). destruct A as [A0 [A1 A2]], B as [B0 [B1 B2]], C as [C0 [C1 C2]], G as [G0 [G1 G2]].
  destruct E as [E0 [E1 E2]].
  assert (X := box_is camera ray_parallel_origin_x _ _ _ _ _ _ _ (rising_right _)
    (parallel_is (camera "rx") (camera "ux") (camera "ox") ray_parallel_origin_x
      (fun p q => eq_refl)) E0 A0 B0 C0 G0 I).
  assert (Y := box_is camera ray_parallel_origin_y _ _ _ _ _ _ _ (rising_right _)
    (parallel_is (camera "ry") (camera "uy") (camera "oy") ray_parallel_origin_y
      (fun p q => eq_refl)) E1 A1 B1 C1 G1 I).
  assert (Z := box_is camera ray_parallel_origin_z _ _ _ _ _ _ _ (rising_right _)
    (parallel_is (camera "rz") (camera "uz") (camera "oz") ray_parallel_origin_z
      (fun p q => eq_refl)) E2 A2 B2 C2 G2 I).
  destruct X as [X0 [X1 [X2 X3]]], Y as [Y0 [Y1 [Y2 Y3]]], Z as [Z0 [Z1 [Z2 Z3]]].
  split; [now repeat split|]. split; [now repeat split|]. split; [exact Fa|]. now repeat split.
Qed.
End Camera.
