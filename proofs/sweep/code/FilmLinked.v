(** All records of the film together are the camera of Perspective.v, or of Orthographic.v.

    A record of FilmCode.v begins from variables where another one ended: the pixel's place, the dual
    axes, [_spread], the bounds. [perspective_linked] and [parallel_linked] say that these variables
    have the values of the other records. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees RecordedFilm RecordedCamera Rounding Camera Place Film Dual
  Bounds Boxes FilmCode.
From Reftrace Require EdgeBounds EdgeFunctions Perspective Orthographic Fit FitParallel.
Open Scope R_scope.
Open Scope string_scope.
Opaque rnd.

Section Linked.
Variable v : renv.
Notation "'$' x" := (r_var v x) (at level 1, x at level 0).
Variables width height i j : Z.

(** What [Film] was given, and what it has found before it looks at vertices. *)
Record linked : Prop := {
  of_width : $"width" = IZR width; of_height : $"height" = IZR height;
  sizes : (1 <= width < 2 ^ 40)%Z /\ (1 <= height < 2 ^ 40)%Z;
  of_i : $"region_x" = IZR i; of_j : $"region_y" = IZR j;
  i_pixel : (0 <= i < width)%Z; j_pixel : (0 <= j < height)%Z;
  axes_float : floats (r_ v) /\ floats (u_ v) /\ floats (f_ v);
  of_px : $"px" = fl v film_position_x; of_py : $"py" = fl v film_position_y;
  of_dr : dr_ v = V (fl v dual_right_x) (fl v dual_right_y) (fl v dual_right_z);
  of_du : du_ v = V (fl v dual_up_x) (fl v dual_up_y) (fl v dual_up_z);
  of_df : df_ v = V (fl v dual_depth_x) (fl v dual_depth_y) (fl v dual_depth_z);
  of_spread : $"spread" = fl v film_spread }.
Record perspective_linked : Prop := {
  p_linked : linked;
  of_weight : $"weight" = fl v film_weight; of_ray_error : $"ray_error" = fl v film_ray_error_perspective;
  of_c0 : $"c0" = fl v film_place_perspective_constant; of_c1 : $"c1" = fl v film_place_perspective_slope }.
Record parallel_linked : Prop := {
  p_linked' : linked;
  of_ray_error' : $"ray_error" = fl v film_ray_error_parallel;
  of_c0' : $"c0" = fl v film_place_parallel_constant; of_c1' : $"c1" = fl v film_place_parallel_slope;
  of_d0 : $"d0" = fl v film_depth_error_constant; of_d1 : $"d1" = fl v film_depth_error_slope }.

Notation m := (largest9 (r_ v) (u_ v) (f_ v)).
Notation x0 := ($"left"). Notation x1 := ($"right"). Notation y0 := ($"bottom"). Notation y1 := ($"top").

(** The hypotheses of Perspective.v and Orthographic.v on [m], [S] and the position's size hold. *)
Theorem linked_facts (L := nine (r_ v) (u_ v) (f_ v)) : linked -> near ($"spread") L (L / 10000) /\
  (within (r_ v) m /\ within (u_ v) m /\ within (f_ v) m) /\ within (o_ v) (largest (o_ v)) /\
  dr_ v = dr (r_ v) (u_ v) (f_ v) /\ du_ v = du (r_ v) (u_ v) (f_ v) /\ df_ v = df (r_ v) (u_ v) (f_ v) /\
  $"px" = film_at (IZR i) ($"dx") /\ $"py" = film_at (IZR j) ($"dy").
Proof.
  unfold L. clear L. intros []. destruct (dual_rows v) as [Er [Eu Ef]].
  rewrite Er in of_dr0. rewrite Eu in of_du0. rewrite Ef in of_df0.
  split; [|split; [apply largest9_within | split; [apply largest_within|]]].
  - rewrite of_spread0. unfold nine. rewrite <- of_dr0, <- of_du0, <- of_df0.
    destruct (dual_floats (r_ v) (u_ v) (f_ v)) as [A [B C]]. apply spread_near; congruence.
  - repeat split; try assumption.
    + rewrite of_px0, position_x; rewrite of_i0; [reflexivity | apply int_float; lia].
    + rewrite of_py0, position_y; rewrite of_j0; [reflexivity | apply int_float; lia].
Qed.

Section PerspectiveLinked.
Hypothesis ok : perspective_linked.
Notation S_ := ($"spread").
Theorem perspective_recorded :
  V (fl v ray_perspective_direction_x) (fl v ray_perspective_direction_y) (fl v ray_perspective_direction_z) =
    Perspective.d (r_ v) (u_ v) (f_ v) x0 x1 y0 y1 width height i j ($"dx") ($"dy") /\
  $"weight" = Perspective.wt S_ /\ $"ray_error" = Perspective.re m S_ x0 x1 y0 y1 width height /\
  $"c0" = 0 /\ $"c1" = Perspective.place_slope m S_ x0 x1 y0 y1 width height /\
  (truth rnd v film_perspective_ahead = true <->
   Perspective.is_ahead (r_ v) (u_ v) (f_ v) (o_ v) S_ (v_ v) (Z_ v)).
Proof.
  destruct ok as [L W RE C0 C1]. destruct (linked_facts L) as [_ [_ [_ [Er [Eu [Ef [Px Py]]]]]]]. destruct L.
  rewrite weight_code in W. rewrite ray_error_code in RE.
  assert (F : is_float ($"ray_error")) by (rewrite RE; apply rnd_float).
  destruct (place_code v F) as [K0 K1]. rewrite K0 in C0. rewrite K1 in C1.
  assert (R : $"ray_error" = Perspective.re m S_ x0 x1 y0 y1 width height).
  { rewrite RE. unfold Perspective.re, ax_, ay_. now rewrite of_width0, of_height0. }
  split; [|split; [|split; [|split; [|split]]]]; try assumption.
  - rewrite (proj2 (perspective_ray v)). unfold Perspective.d, x_, y_, width_, height_.
    now rewrite Px, Py, of_width0, of_height0.
  - rewrite C1, R. unfold Perspective.place_slope, Perspective.slope_x, Perspective.slope_y, width_, height_,
      ax_, ay_.
    now rewrite of_width0, of_height0.
  - rewrite ahead_code. unfold Perspective.is_ahead, w_. rewrite Ef, W. reflexivity.
Qed.
(** Vertices, and the ends of their boxes: [K] is the float 1.01, [far] 2 max (width, height). *)
Theorem perspective_recorded_vertex (b := fun f dz =>
    f (r_ v) (u_ v) (f_ v) (o_ v) m S_ x0 x1 y0 y1 width height dz
    (far_ v) EdgeBounds.more (v_ v) (Z_ v) : R) :
  fl v film_perspective_lowest_x = b Perspective.low_x ($"dx") /\
  fl v film_perspective_lowest_y = b Perspective.low_y ($"dy") /\
  fl v film_perspective_minus_highest_x = b Perspective.high_x ($"dx") /\
  fl v film_perspective_minus_highest_y = b Perspective.high_y ($"dy").
Proof.
  destruct perspective_recorded as [_ [W [RE [C0 [C1 _]]]]]. destruct ok as [L _ _ _ _].
  destruct (linked_facts L) as [_ [_ [_ [Er [Eu [Ef _]]]]]]. destruct L.
  destruct (boxes_code v width height of_width0 of_height0 sizes0) as [A [B [C [D _]]]]. rewrite A, B, C, D.
  unfold b, Perspective.low_x, Perspective.low_y, Perspective.high_x, Perspective.high_y,
    p_, q_, w_, width_, height_.
  rewrite W, C0, C1, Er, Eu, Ef, of_width0, of_height0. repeat split.
Qed.
(** What the theorems of Fit.v begin from: what is stored of the vertex, and [set_up]'s bounds. *)
Theorem perspective_recorded_stored :
  V (fl v film_perspective_p) (fl v film_perspective_q) (fl v film_perspective_w) =
    Fit.stored (r_ v) (u_ v) (f_ v) (o_ v) x0 x1 y0 y1 width height ($"dx") ($"dy") (v_ v) /\
  (exists A O, within (v_ v) A /\ within (o_ v) O /\ fl v film_perspective_size = vertex_size A O) /\
  forall size, rnd ($"c0" + rnd ($"c1" * size)) = Fit.place_of m S_ x0 x1 y0 y1 width height size /\
    rnd ($"weight" * size) = Fit.weight_of S_ size.
Proof.
  destruct perspective_recorded as [_ [W [RE [C0 [C1 _]]]]]. destruct ok as [L _ _ _ _].
  destruct (linked_facts L) as [_ [_ [_ [Er [Eu [Ef _]]]]]]. destruct L.
  destruct (perspective_enter v) as [P [Q [W' [_ [Z _]]]]]. split; [|split].
  - rewrite P, Q, W'. unfold Fit.stored, p_, q_, w_, width_, height_.
    rewrite Er, Eu, Ef, of_width0, of_height0. reflexivity.
  - exists (largest (v_ v)), (largest (o_ v)). rewrite Z. repeat split; apply largest_within.
  - intros size. now rewrite C0, C1, W.
Qed.
End PerspectiveLinked.

Section ParallelLinked.
Hypothesis ok : parallel_linked.
Notation S_ := ($"spread"). Notation most := (largest (o_ v)).
Theorem parallel_recorded :
  V (fl v ray_parallel_origin_x) (fl v ray_parallel_origin_y) (fl v ray_parallel_origin_z) =
    Orthographic.oh (r_ v) (u_ v) (o_ v) x0 x1 y0 y1 width height i j ($"dx") ($"dy") /\
  $"ray_error" = Orthographic.re' m most S_ x0 x1 y0 y1 width height /\
  $"c0" = Orthographic.place_constant m most S_ x0 x1 y0 y1 width height /\
  $"c1" = Orthographic.place_slope' S_ x0 x1 y0 y1 width height /\
  $"d0" = 2 * $"ray_error" /\ $"d1" = weight S_.
Proof.
  destruct ok as [L RE C0 C1 D0 D1]. destruct (linked_facts L) as [_ [_ [_ [_ [_ [_ [Px Py]]]]]]].
  destruct L. rewrite ray_error_code' in RE.
  assert (F : is_float ($"ray_error")) by (rewrite RE; apply rnd_float).
  destruct (place_code' v F) as [K0 K1]. rewrite K0 in C0. rewrite K1 in C1.
  destruct (depth_error_code v F) as [G0 G1]. rewrite G0 in D0. rewrite G1 in D1.
  assert (R : $"ray_error" = Orthographic.re' m most S_ x0 x1 y0 y1 width height).
  { rewrite RE. unfold Orthographic.re', ax_, ay_. now rewrite of_width0, of_height0. }
  split; [|split; [|split; [|split; [|split]]]]; try assumption.
  - rewrite (proj1 (parallel_ray v)). unfold Orthographic.oh, x_, y_, width_, height_.
    now rewrite Px, Py, of_width0, of_height0.
  - rewrite C0, R. unfold Orthographic.place_constant, width_, height_. now rewrite of_width0, of_height0.
  - rewrite C1. unfold Orthographic.place_slope', width_, height_. now rewrite of_width0, of_height0.
Qed.
Theorem parallel_recorded_vertex (b := fun f dz =>
    f (r_ v) (u_ v) (f_ v) (o_ v) m most S_ x0 x1 y0 y1 width height dz
    (far_ v) EdgeBounds.more (v_ v) (Z_ v) : R) :
  fl v film_parallel_lowest_x = b Orthographic.low_x ($"dx") /\
  fl v film_parallel_lowest_y = b Orthographic.low_y ($"dy") /\
  fl v film_parallel_minus_highest_x = b Orthographic.high_x ($"dx") /\
  fl v film_parallel_minus_highest_y = b Orthographic.high_y ($"dy").
Proof.
  destruct parallel_recorded as [_ [RE [C0 [C1 _]]]]. destruct ok as [L _ _ _ _ _].
  destruct (linked_facts L) as [_ [_ [_ [Er [Eu _]]]]]. destruct L.
  destruct (boxes_code' v width height of_width0 of_height0 sizes0) as [A [B [C [D _]]]]. rewrite A, B, C, D.
  unfold b, Orthographic.low_x, Orthographic.low_y, Orthographic.high_x, Orthographic.high_y,
    p_, q_, width_, height_.
  rewrite C0, C1, Er, Eu, of_width0, of_height0. repeat split.
Qed.
(** What the theorems of FitParallel.v begin from. *)
Theorem parallel_recorded_stored :
  V (fl v film_parallel_p) (fl v film_parallel_q) (fl v film_parallel_w) =
    FitParallel.stored' (r_ v) (u_ v) (f_ v) (o_ v) x0 x1 y0 y1 width height ($"dx") ($"dy") (v_ v) /\
  (exists A, within (v_ v) A /\ fl v film_parallel_size = vertex_size A most) /\
  forall size, rnd ($"c0" + rnd ($"c1" * size)) = FitParallel.place_of' m most S_ x0 x1 y0 y1 width height
    size.
Proof.
  destruct parallel_recorded as [_ [RE [C0 [C1 _]]]]. destruct ok as [L _ _ _ _ _].
  destruct (linked_facts L) as [_ [_ [_ [Er [Eu _]]]]]. destruct L.
  destruct (parallel_enter v) as [P [Q [W' [_ [Z _]]]]]. split; [|split].
  - rewrite P, Q, W'. unfold FitParallel.stored', p_, q_, width_, height_.
    rewrite Er, Eu, of_width0, of_height0. reflexivity.
  - exists (largest (v_ v)). rewrite Z. split; [apply largest_within | reflexivity].
  - intros size. now rewrite C0, C1.
Qed.
End ParallelLinked.
End Linked.
