(** The film's code, as it was recorded while it ran, is what Perspective.v and Orthographic.v speak of.

    recorded/ has the expressions of [film.py] and [camera.py] as numpy executed them. Here: what each
    of them is worth, as floats, is the formula that the theorems are about, for all inputs. Some need
    an input to be a float, or a picture's size to be an integer: they say so.

    A record begins from variables where another one ended: the dual axes, [_spread], the bounds.
    FilmLinked.v puts them together. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees RecordedFilm RecordedCamera Rounding Camera Place Film Dual
  Bounds Boxes.
From Reftrace Require EdgeBounds EdgeFunctions Perspective Orthographic.
Open Scope R_scope.
Open Scope string_scope.
Opaque rnd.

(** ** The numbers that are written in the code *)
Lemma n_0 : IZR 0 * bpow radix2 0 = 0. Proof. simpl; lra. Qed.
Lemma n_1 : IZR 1 * bpow radix2 0 = 1. Proof. simpl; lra. Qed.
Lemma n_2 : IZR 1 * bpow radix2 1 = 2. Proof. simpl; lra. Qed.
Lemma n_m2 : IZR (-1) * bpow radix2 1 = - 2. Proof. simpl; lra. Qed.
Lemma n_half : IZR 1 * bpow radix2 (-1) = / 2. Proof. simpl. lra. Qed.
Lemma n_1024 : IZR 1 * bpow radix2 10 = 1024. Proof. simpl; lra. Qed.
Lemma n_24 : IZR 3 * bpow radix2 (-49) = 24 * eps.
Proof. unfold eps. change (-49)%Z with (3 + -52)%Z. rewrite bpow_plus. simpl (bpow radix2 3). lra. Qed.
Lemma n_72 : IZR 9 * bpow radix2 (-49) = 72 * eps.
Proof. unfold eps. change (-49)%Z with (3 + -52)%Z. rewrite bpow_plus. simpl (bpow radix2 3). lra. Qed.
Lemma n_64 : IZR 1 * bpow radix2 (-46) = 64 * eps.
Proof. unfold eps. change (-46)%Z with (6 + -52)%Z. rewrite bpow_plus. simpl (bpow radix2 6). lra. Qed.
Lemma n_tiny : IZR 1 * bpow radix2 (-960) = tiny. Proof. unfold tiny. ring. Qed.
Lemma n_nearest : IZR 281474976710657 * bpow radix2 (-48) = rnd (1 + bpow radix2 (-48)).
Proof.
  assert (E : IZR 281474976710657 * bpow radix2 (-48) = 1 + bpow radix2 (-48)).
  { change (bpow radix2 (-48)) with (/ 281474976710656). lra. }
  rewrite <- E. symmetry. now apply rnd_id, number_float.
Qed.
#[local] Hint Rewrite n_0 n_1 n_2 n_m2 n_half n_1024 n_24 n_72 n_64 n_tiny n_nearest : numbers.

Ltac code := intros; cbn [value truth]; autorewrite with numbers.

Lemma rnd_int k : (Z.abs k < 2 ^ 53)%Z -> rnd (IZR k) = IZR k.
Proof. intros. apply rnd_id, int_float. assumption. Qed.

Section Code.
Variable v : renv.
Notation "'$' x" := (r_var v x) (at level 1, x at level 0).

(** ** The vectors that the variables are the components of *)
Definition r_ := V ($"rx") ($"ry") ($"rz").
Definition u_ := V ($"ux") ($"uy") ($"uz").
Definition f_ := V ($"fx") ($"fy") ($"fz").
Definition o_ := V ($"ox") ($"oy") ($"oz").
Definition v_ := V ($"vx") ($"vy") ($"vz").
Definition dr_ := V ($"right_x") ($"right_y") ($"right_z").
Definition du_ := V ($"up_x") ($"up_y") ($"up_z").
Definition df_ := V ($"depth_x") ($"depth_y") ($"depth_z").
(** The largest |component| of a vector, and of the nine of the axes. *)
Definition largest (a : vec) := Rmax (Rmax (Rabs (vx a)) (Rabs (vy a))) (Rabs (vz a)).
Definition largest9 (a b c : vec) :=
  Rmax (Rmax (Rmax (Rmax (Rmax (Rmax (largest a) (Rabs (vx b))) (Rabs (vy b))) (Rabs (vz b)))
    (Rabs (vx c))) (Rabs (vy c))) (Rabs (vz c)).
Definition width_ := pixel_size ($"left") ($"right") ($"width").
Definition height_ := pixel_size ($"bottom") ($"top") ($"height").
Definition ax_ := window ($"left") ($"right") ($"width").
Definition ay_ := window ($"bottom") ($"top") ($"height").

Lemma largest_within a : within a (largest a).
Proof.
  unfold within, largest. repeat split; eauto using Rmax_l, Rmax_r, Rle_trans.
Qed.
Lemma largest9_within a b c :
  within a (largest9 a b c) /\ within b (largest9 a b c) /\ within c (largest9 a b c).
Proof.
  unfold within, largest9, largest.
  repeat split; repeat first [apply Rmax_r | apply Rle_refl | eapply Rle_trans; [|apply Rmax_l]].
Qed.

(** ** [film_positions] and [camera_rays] *)
(** The pixel's number, a float, within its tile: [+ x0] is what was recorded, of the tile's first. *)
Lemma position_x : is_float ($"region_x") -> fl v film_position_x = film_at ($"region_x") ($"dx").
Proof. unfold film_position_x. code. now rewrite Rplus_0_l, (rnd_id _ H). Qed.
Lemma position_y : is_float ($"region_y") -> fl v film_position_y = film_at ($"region_y") ($"dy").
Proof. unfold film_position_y. code. now rewrite Rplus_0_l, (rnd_id _ H). Qed.

Definition x_ := window_at ($"left") ($"px") width_.
Definition y_ := window_at ($"bottom") ($"py") height_.
Theorem perspective_ray :
  V (fl v ray_perspective_origin_x) (fl v ray_perspective_origin_y) (fl v ray_perspective_origin_z) = o_ /\
  V (fl v ray_perspective_direction_x) (fl v ray_perspective_direction_y) (fl v ray_perspective_direction_z) =
  fdirection x_ y_ r_ u_ f_.
Proof. split; reflexivity. Qed.
(** The origin's code adds the other way round: [origin + (x * right + y * up)]. *)
Theorem parallel_ray :
  V (fl v ray_parallel_origin_x) (fl v ray_parallel_origin_y) (fl v ray_parallel_origin_z) =
  fdirection x_ y_ r_ u_ o_ /\
  V (fl v ray_parallel_direction_x) (fl v ray_parallel_direction_y) (fl v ray_parallel_direction_z) = f_.
Proof.
  split; [|reflexivity]. unfold fdirection, ray_part. rewrite 3!(Rplus_comm (rnd _) (_ o_)). reflexivity.
Qed.

(** ** [dual_axes] *)
Theorem dual_rows :
  V (fl v dual_right_x) (fl v dual_right_y) (fl v dual_right_z) = dr r_ u_ f_ /\
  V (fl v dual_up_x) (fl v dual_up_y) (fl v dual_up_z) = du r_ u_ f_ /\
  V (fl v dual_depth_x) (fl v dual_depth_y) (fl v dual_depth_z) = df r_ u_ f_.
Proof. repeat split; reflexivity. Qed.

(** ** [_spread], [weight], [ray_error], [place], [depth_error] *)
Lemma spread_code : fl v film_spread =
  sum9 (Rabs ($"right_x")) (Rabs ($"right_y")) (Rabs ($"right_z")) (Rabs ($"up_x")) (Rabs ($"up_y"))
    (Rabs ($"up_z")) (Rabs ($"depth_x")) (Rabs ($"depth_y")) (Rabs ($"depth_z")).
Proof. reflexivity. Qed.
Theorem spread_near : floats dr_ -> floats du_ -> floats df_ ->
  let s := L1 dr_ + L1 du_ + L1 df_ in near (fl v film_spread) s (s / 10000).
Proof.
  intros [A0 [A1 A2]] [B0 [B1 B2]] [C0 [C1 C2]] s. rewrite spread_code.
  simpl vx in *. simpl vy in *. simpl vz in *.
  replace s with (Rabs ($"right_x") + Rabs ($"right_y") + (Rabs ($"right_z") + Rabs ($"up_x")) +
    (Rabs ($"up_y") + Rabs ($"up_z") + (Rabs ($"depth_x") + Rabs ($"depth_y"))) + Rabs ($"depth_z"))
    by (unfold s, L1, dr_, du_, df_; simpl; ring).
  apply sum9_near. simpl. intros x H.
  repeat (destruct H as [<-|H]; [split; [now apply is_float_abs | apply Rabs_pos]|]). contradiction.
Qed.

Lemma weight_code : fl v film_weight = weight ($"spread").
Proof. unfold film_weight. code. reflexivity. Qed.
Lemma depth_error_code : is_float ($"ray_error") ->
  fl v film_depth_error_constant = 2 * $"ray_error" /\ fl v film_depth_error_slope = weight ($"spread").
Proof.
  unfold film_depth_error_constant, film_depth_error_slope. code.
  split; [now apply EdgeBounds.rnd_2 | reflexivity].
Qed.

Notation far_reach := (rnd (reach ax_ + reach ay_)).
Lemma ray_error_code : fl v film_ray_error_perspective =
  ray_error ($"spread") (length (largest9 r_ u_ f_) far_reach).
Proof. unfold film_ray_error_perspective. code. reflexivity. Qed.
Lemma ray_error_code' : fl v film_ray_error_parallel =
  ray_error ($"spread") (length' (largest9 r_ u_ f_) (largest o_) far_reach).
Proof. unfold film_ray_error_parallel. code. reflexivity. Qed.

(** Python's [max] begins from 0 and goes along x, then y. *)
Lemma place_code : is_float ($"ray_error") -> fl v film_place_perspective_constant = 0 /\
  fl v film_place_perspective_slope =
  let along left size reach := slope ($"spread") (own_error left size)
    (film_error left size ($"width") ($"height")) (ray_part_error ($"ray_error") reach size) in
  Rmax (Rmax 0 (along ($"left") width_ (reach ax_))) (along ($"bottom") height_ (reach ay_)).
Proof.
  intros F. unfold film_place_perspective_constant, film_place_perspective_slope. code.
  split; [reflexivity|]. rewrite (EdgeBounds.rnd_2 _ F). reflexivity.
Qed.
Lemma place_code' : is_float ($"ray_error") ->
  fl v film_place_parallel_constant =
  (let along left size := constant' (film_error left size ($"width") ($"height")) ($"ray_error") size in
   Rmax (Rmax 0 (along ($"left") width_)) (along ($"bottom") height_)) /\
  fl v film_place_parallel_slope = Rmax (Rmax 0 (slope' ($"spread") width_)) (slope' ($"spread") height_).
Proof.
  intros F. unfold film_place_parallel_constant, film_place_parallel_slope. code.
  split; [rewrite (EdgeBounds.rnd_2 _ F)|]; reflexivity.
Qed.

(** ** [enter]: where a vertex is *)
Definition Z_ := vertex_size (largest v_) (largest o_).
Definition w_ := fdot df_ (fsub v_ o_).
Definition p_ (w : R) := film_position (fdot dr_ (fsub v_ o_)) w ($"left") width_ ($"dx").
Definition q_ (w : R) := film_position (fdot du_ (fsub v_ o_)) w ($"bottom") height_ ($"dy").

Theorem perspective_enter :
  fl v film_perspective_p = p_ w_ /\ fl v film_perspective_q = q_ w_ /\ fl v film_perspective_w = w_ /\
  fl v film_perspective_depth = w_ /\ fl v film_perspective_size = Z_ /\
  fl v film_perspective_x = rnd (p_ w_ / w_) /\ fl v film_perspective_y = rnd (q_ w_ / w_).
Proof.
  unfold film_perspective_p, film_perspective_q, film_perspective_w, film_perspective_depth,
    film_perspective_size, film_perspective_x, film_perspective_y.
  code. repeat split; reflexivity.
Qed.
Theorem parallel_enter :
  fl v film_parallel_p = p_ 1 /\ fl v film_parallel_q = q_ 1 /\ fl v film_parallel_w = 1 /\
  fl v film_parallel_depth = w_ /\ fl v film_parallel_size = Z_ /\
  fl v film_parallel_x = rnd (p_ 1 / 1) /\ fl v film_parallel_y = rnd (q_ 1 / 1).
Proof.
  unfold film_parallel_p, film_parallel_q, film_parallel_w, film_parallel_depth,
    film_parallel_size, film_parallel_x, film_parallel_y.
  code. repeat split; reflexivity.
Qed.

Lemma less_iff a b : Rlt_bool a b = true <-> a < b.
Proof. split; [case Rlt_bool_spec; [auto | discriminate] | apply Rlt_bool_true]. Qed.
(** [ahead] asks, too, whether x and y are finite: of real numbers, they are. *)
Theorem ahead_code : truth rnd v film_perspective_ahead = true <->
  rnd (rnd (1024 * $"weight") * Z_) < w_.
Proof.
  unfold film_perspective_ahead. code. rewrite !andb_true_r.
  apply less_iff.
Qed.
Theorem ahead_code' : truth rnd v film_parallel_ahead = true.
Proof.
  unfold film_parallel_ahead. code. rewrite !andb_true_r. apply Rlt_bool_true.
  rewrite Rmult_0_l, rnd_0. apply Rlt_0_1.
Qed.

Notation more := EdgeBounds.more. (* the float 1.01 *)
Definition far_ := rnd (2 * Rmax ($"width") ($"height")).

(** ** [nearest] *)
Theorem nearest_code :
  fl v film_perspective_nearest = nearest w_ Z_ ($"weight") ($"ray_error") ($"clip_start").
Proof. unfold film_perspective_nearest. code. reflexivity. Qed.
Theorem nearest_code' : fl v film_parallel_nearest = nearest' w_ Z_ ($"d0") ($"d1").
Proof. unfold film_parallel_nearest. code. reflexivity. Qed.

(** ** Boxes *)
Lemma more_ok : 10099 / 10000 <= more. Proof. generalize EdgeBounds.more_value. lra. Qed.

Section Boxes.
(** What depends on the projection: the vertex's w, and the film's [weight]. *)
Variables n n' : Z.
Hypothesis width_int : $"width" = IZR n.
Hypothesis height_int : $"height" = IZR n'.
Hypothesis sizes : (1 <= n < 2 ^ 40)%Z /\ (1 <= n' < 2 ^ 40)%Z.
Notation low := (lowest ($"c0") ($"c1")).
Notation high := (highest ($"c0") ($"c1")).

Lemma far_value : far_ = 2 * Rmax (IZR n) (IZR n').
Proof.
  unfold far_. rewrite width_int, height_int. apply EdgeBounds.rnd_2. unfold Rmax.
  destruct (Rle_dec (IZR n) (IZR n')); apply int_float; lia.
Qed.
Lemma far_ok : 2 * IZR n <= far_ /\ 2 * IZR n' <= far_ /\ far_ <= 2 * (IZR n + IZR n').
Proof.
  rewrite far_value. assert (1 <= IZR n) by (apply IZR_le; lia). assert (1 <= IZR n') by (apply IZR_le; lia).
  generalize (Rmax_l (IZR n) (IZR n')) (Rmax_r (IZR n) (IZR n')).
  unfold Rmax. destruct (Rle_dec (IZR n) (IZR n')); lra.
Qed.
(** The ends that boxes are clipped to are integers: nothing is rounded. *)
Lemma ends k : (1 <= k < 2 ^ 40)%Z -> rnd (IZR k + 2) = IZR k + 2 /\ rnd (- IZR k - 2) = - IZR k - 2.
Proof.
  intros K. rewrite <- (plus_IZR k 2), <- opp_IZR, <- (minus_IZR (- k) 2). split; apply rnd_int; lia.
Qed.
Notation ends_x := (ends n (proj1 sizes)).
Notation ends_y := (ends n' (proj2 sizes)).

Theorem boxes_code (wt := $"weight") :
  fl v film_perspective_lowest_x = low wt Z_ far_ more (p_ w_) w_ (IZR n) /\
  fl v film_perspective_lowest_y = low wt Z_ far_ more (q_ w_) w_ (IZR n') /\
  fl v film_perspective_minus_highest_x = high wt Z_ far_ more (p_ w_) w_ (IZR n) /\
  fl v film_perspective_minus_highest_y = high wt Z_ far_ more (q_ w_) w_ (IZR n') /\
  fl v film_perspective_margin = margin_3 ($"c0") ($"c1") wt Z_ far_ more w_.
Proof.
  unfold film_perspective_lowest_x, film_perspective_lowest_y, film_perspective_minus_highest_x,
    film_perspective_minus_highest_y, film_perspective_margin. code. unfold lowest, highest, clip.
  rewrite <- (proj1 ends_x), <- (proj1 ends_y), <- (proj2 ends_x), <- (proj2 ends_y), <- width_int,
    <- height_int.
  repeat split; reflexivity.
Qed.
Theorem boxes_code' :
  fl v film_parallel_lowest_x = low 0 Z_ far_ more (p_ 1) 1 (IZR n) /\
  fl v film_parallel_lowest_y = low 0 Z_ far_ more (q_ 1) 1 (IZR n') /\
  fl v film_parallel_minus_highest_x = high 0 Z_ far_ more (p_ 1) 1 (IZR n) /\
  fl v film_parallel_minus_highest_y = high 0 Z_ far_ more (q_ 1) 1 (IZR n') /\
  fl v film_parallel_margin = margin_3 ($"c0") ($"c1") 0 Z_ far_ more 1.
Proof.
  unfold film_parallel_lowest_x, film_parallel_lowest_y, film_parallel_minus_highest_x,
    film_parallel_minus_highest_y, film_parallel_margin. code. unfold lowest, highest, clip.
  rewrite <- (proj1 ends_x), <- (proj1 ends_y), <- (proj2 ends_x), <- (proj2 ends_y), <- width_int,
    <- height_int.
  repeat split; reflexivity.
Qed.
End Boxes.
End Code.
