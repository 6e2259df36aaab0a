(** A camera's film in exact arithmetic: why the pixel of a ray and three points of the plane decide
    what the ray meets, and why an error of the ray is an error of the vertices.

    Everything here is algebra of determinants; nothing is rounded. [place] and [weight] of
    docs/speed.md, "The bound, and what it proves", rest on it: [Film.v] has the roundings. *)
Require Import Reals Psatz.
From Reftrace Require Import Geometry.
Open Scope R_scope.

Lemma vec_eq u v : vx u = vx v -> vy u = vy v -> vz u = vz v -> u = v.
Proof. destruct u, v; simpl; intros; subst; reflexivity. Qed.
Lemma vx_V a b c : vx (V a b c) = a. Proof. reflexivity. Qed.
Lemma det_scale s u v w : det (vscale s u) (vscale s v) (vscale s w) = s * s * s * det u v w.
Proof. unfold det, dot, cross, vscale; simpl; ring. Qed.

Section Camera.
(** The axes need not be orthonormal. [volume] is their determinant; it is negative if mirrored. *)
Variables right up forward : vec.
Definition volume := det right up forward.
Hypothesis solid : volume <> 0.

(** The dual axes, exactly: the rows of the inverse. *)
Definition dual_right := vscale (/ volume) (cross up forward).
Definition dual_up := vscale (/ volume) (cross forward right).
Definition dual_depth := vscale (/ volume) (cross right up).
(** A vector's coordinates along right, up, forward; and the vector with such coordinates. *)
Definition coords (v : vec) := V (dot dual_right v) (dot dual_up v) (dot dual_depth v).
Definition from (c : vec) := vadd (vadd (vscale (vx c) right) (vscale (vy c) up)) (vscale (vz c) forward).

Lemma from_coords v : from (coords v) = v.
Proof.
  revert solid. unfold from, coords, dual_right, dual_up, dual_depth.
  set (k := / volume). intros H. assert (K : k * volume = 1) by (unfold k; now field).
  clearbody k. unfold volume, det, dot, cross, vadd, vscale in *.
  destruct right as [a b c], up as [d e f], forward as [g h i], v as [x y z]; simpl in *.
  apply vec_eq; simpl.
  - transitivity (x * (k * ((b * f - c * e) * g + (c * d - a * f) * h + (a * e - b * d) * i))); [ring | rewrite K; ring].
  - transitivity (y * (k * ((b * f - c * e) * g + (c * d - a * f) * h + (a * e - b * d) * i))); [ring | rewrite K; ring].
  - transitivity (z * (k * ((b * f - c * e) * g + (c * d - a * f) * h + (a * e - b * d) * i))); [ring | rewrite K; ring].
Qed.

Lemma coords_from c : coords (from c) = c.
Proof.
  revert solid. unfold from, coords, dual_right, dual_up, dual_depth.
  set (k := / volume). intros H. assert (K : k * volume = 1) by (unfold k; now field).
  clearbody k. unfold volume, det, dot, cross, vadd, vscale in *.
  destruct right as [a b c'], up as [d e f], forward as [g h i], c as [x y z]; simpl in *.
  apply vec_eq; simpl.
  - transitivity (x * (k * ((b * f - c' * e) * g + (c' * d - a * f) * h + (a * e - b * d) * i))); [ring | rewrite K; ring].
  - transitivity (y * (k * ((b * f - c' * e) * g + (c' * d - a * f) * h + (a * e - b * d) * i))); [ring | rewrite K; ring].
  - transitivity (z * (k * ((b * f - c' * e) * g + (c' * d - a * f) * h + (a * e - b * d) * i))); [ring | rewrite K; ring].
Qed.

Lemma coords_add u v : coords (vadd u v) = vadd (coords u) (coords v).
Proof. unfold coords, vadd, dot; apply vec_eq; simpl; ring. Qed.
Lemma coords_sub u v : coords (vsub u v) = vsub (coords u) (coords v).
Proof. unfold coords, vsub, dot; apply vec_eq; simpl; ring. Qed.
Lemma coords_scale s v : coords (vscale s v) = vscale s (coords v).
Proof. unfold coords, vscale, dot; apply vec_eq; simpl; ring. Qed.

Lemma det_from a b c : det (from a) (from b) (from c) = volume * det a b c.
Proof.
  unfold volume, from, det, dot, cross, vadd, vscale.
  destruct right, up, forward, a, b, c; simpl; ring.
Qed.
Lemma det_coords a b c : det a b c = volume * det (coords a) (coords b) (coords c).
Proof. now rewrite <- det_from, !from_coords. Qed.

(** The film: pixels of the window's plane, in homogeneous coordinates, and shifted by (dx, dy), by
    which rays pass their pixel's centre. *)
Variables left bottom width height dx dy : R.
Hypothesis width_pos : 0 < width.
Hypothesis height_pos : 0 < height.
Definition film (c : vec) :=
  V ((vx c - left * vz c) / width - dx * vz c) ((vy c - bottom * vz c) / height - dy * vz c) (vz c).
(** The shear that moves by (ex, ey) pixels: what is at depth w, in p and q, by as much times w. *)
Definition shear (ex ey : R) (c : vec) := V (vx c - ex * vz c) (vy c - ey * vz c) (vz c).

Lemma film_add u v : film (vadd u v) = vadd (film u) (film v).
Proof. unfold film, vadd; apply vec_eq; simpl; field; lra. Qed.
Lemma film_scale s v : film (vscale s v) = vscale s (film v).
Proof. unfold film, vscale; apply vec_eq; simpl; try field; lra. Qed.
Lemma shear_add ex ey u v : shear ex ey (vadd u v) = vadd (shear ex ey u) (shear ex ey v).
Proof. unfold shear, vadd; apply vec_eq; simpl; ring. Qed.
Lemma shear_scale ex ey s v : shear ex ey (vscale s v) = vscale s (shear ex ey v).
Proof. unfold shear, vscale; apply vec_eq; simpl; ring. Qed.
Lemma det_film a b c : det (film a) (film b) (film c) = det a b c / (width * height).
Proof. unfold det, dot, cross, film; simpl; field; lra. Qed.
Lemma det_shear ex ey a b c : det (shear ex ey a) (shear ex ey b) (shear ex ey c) = det a b c.
Proof. unfold det, dot, cross, shear; simpl; ring. Qed.

(** ** Perspective *)
Section Perspective.
Variables (o d : vec) (x y s : R). (* the ray as it is stored, and the pixel's centre *)
Hypothesis s_pos : 0 < s.
Definition ray_depth := vz (coords d).
Hypothesis ahead : 0 < ray_depth.
(** How far from (x, y) the ray passes, in pixels. *)
Definition off_x := vx (film (coords d)) / ray_depth - x.
Definition off_y := vy (film (coords d)) / ray_depth - y.
(** The vertices as this ray sees them: p', q', w'. All may have one factor s > 0. *)
Definition seen (v : vec) := vscale s (shear off_x off_y (film (coords (vsub v o)))).

Lemma seen_ray : shear off_x off_y (film (coords d)) = vscale ray_depth (V x y 1).
Proof.
  revert ahead. unfold shear, off_x, off_y, ray_depth. set (c := coords d). clearbody c.
  destruct c as [cx cy cz]. unfold film, vscale; simpl. intros H.
  apply vec_eq; simpl; field; repeat split; lra.
Qed.

Theorem perspective_edge a b :
  edge (Ray o d) a b =
  volume * (width * height * ray_depth / (s * s)) * det (seen a) (seen b) (V x y 1).
Proof.
  rewrite edge_other; simpl.
  transitivity (det (vsub a o) (vsub b o) d).
  { unfold det, dot, cross, vsub; simpl; ring. }
  rewrite det_coords.
  assert (E : det (seen a) (seen b) (vscale ray_depth (V x y 1)) =
              s * s * (det (coords (vsub a o)) (coords (vsub b o)) (coords d) / (width * height))).
  { rewrite <- det_film, <- (det_shear off_x off_y), <- seen_ray. unfold seen.
    unfold det, dot, cross, vscale; simpl; ring. }
  assert (F : det (seen a) (seen b) (vscale ray_depth (V x y 1)) =
              ray_depth * det (seen a) (seen b) (V x y 1)).
  { unfold det, dot, cross, vscale; simpl; ring. }
  rewrite F in E. clear F.
  set (K := det (seen a) (seen b) (V x y 1)) in *.
  set (L := det (coords (vsub a o)) (coords (vsub b o)) (coords d)) in *.
  assert (G : L = width * height / (s * s) * (ray_depth * K)) by (rewrite E; field; repeat split; lra).
  rewrite G. field. lra.
Qed.

Theorem perspective_volume a b c :
  numerator (Ray o d) (Triangle a b c) =
  volume * (width * height / (s * s * s)) * det (seen a) (seen b) (seen c).
Proof.
  transitivity (det (vsub a o) (vsub b o) (vsub c o)).
  { unfold numerator, normal, det, dot, cross, vsub; simpl; ring. }
  rewrite det_coords. unfold seen. rewrite det_scale, det_shear, det_film. field.
  repeat split; lra.
Qed.

(** 1/t = (e_bc + e_ca + e_ab) / T, times a factor that is 1 but for the ray's own error. *)
Theorem perspective_nearness a b c (r := Ray o d) (tri := Triangle a b c) :
  numerator r tri <> 0 -> denominator r tri <> 0 ->
  / depth r tri =
  ray_depth * s * ((det (seen b) (seen c) (V x y 1) + det (seen c) (seen a) (V x y 1) +
                    det (seen a) (seen b) (V x y 1)) / det (seen a) (seen b) (seen c)).
Proof.
  intros N D. unfold depth, tri in *. rewrite denominator_sum in *; simpl in *.
  revert N D. unfold r. rewrite perspective_volume, !perspective_edge.
  set (ab := det (seen a) (seen b) (V x y 1)). set (bc := det (seen b) (seen c) (V x y 1)).
  set (ca := det (seen c) (seen a) (V x y 1)). set (T := det (seen a) (seen b) (seen c)).
  clearbody ab bc ca T. intros N D.
  assert (T <> 0). { intros Z. apply N. rewrite Z. ring. }
  assert (ab + bc + ca <> 0).
  { intros Z. apply D.
    transitivity (volume * (width * height * ray_depth / (s * s)) * (ab + bc + ca)); [ring|].
    rewrite Z. ring. }
  field. repeat split; try lra; try assumption.
  intros Z. apply D. 
  transitivity (width * height * ray_depth * volume * (ab + bc + ca) / (s * s)); [field; lra|].
  rewrite <- (Rmult_0_l (/ (s * s))). unfold Rdiv. f_equal. rewrite <- Z. ring.
Qed.

(** A point of the ray is seen where the pixel is. *)
Lemma seen_at t : seen (at_ (Ray o d) t) = vscale (t * s * ray_depth) (V x y 1).
Proof.
  unfold seen, at_; simpl.
  replace (vsub (vadd o (vscale t d)) o) with (vscale t d)
    by (apply vec_eq; unfold vsub, vadd, vscale; simpl; ring).
  rewrite coords_scale, film_scale, shear_scale, seen_ray.
  apply vec_eq; unfold vscale; simpl; ring.
Qed.

(** So of a triangle that the ray meets, with weights that are not negative, the pixel is the mean. *)
Lemma seen_mean i j k a b c : i + j + k = 1 ->
  seen (vadd (vscale i a) (vadd (vscale j b) (vscale k c))) =
  vadd (vscale i (seen a)) (vadd (vscale j (seen b)) (vscale k (seen c))).
Proof.
  intros H. unfold seen.
  replace (vsub (vadd (vscale i a) (vadd (vscale j b) (vscale k c))) o) with
    (vadd (vscale i (vsub a o)) (vadd (vscale j (vsub b o)) (vscale k (vsub c o)))).
  - rewrite !coords_add, !coords_scale, !film_add, !film_scale, !shear_add, !shear_scale.
    apply vec_eq; unfold vadd, vscale; simpl; ring.
  - replace i with (1 - j - k) by lra. apply vec_eq; unfold vsub, vadd, vscale; simpl; ring.
Qed.
End Perspective.

(** ** Orthographic: rays along [forward], from an origin oh beside the camera's own, o *)
Section Parallel.
Variables (o oh : vec) (x y : R).
Definition beside := coords (vsub oh o).
Definition off_x' := (vx beside - left) / width - dx - x.
Definition off_y' := (vy beside - bottom) / height - dy - y.
(** Where a vertex is, w = 1, and its depth; less the ray's own errors. *)
Definition seen' (v : vec) :=
  V ((vx (coords (vsub v o)) - left) / width - dx - off_x')
    ((vy (coords (vsub v o)) - bottom) / height - dy - off_y') 1.
Definition depth' (v : vec) := vz (coords (vsub v o)) - vz beside.

Lemma coords_beside v : coords (vsub v oh) =
  V (width * (vx (seen' v) - x)) (height * (vy (seen' v) - y)) (depth' v).
Proof.
  replace (vsub v oh) with (vsub (vsub v o) (vsub oh o)) by (apply vec_eq; simpl; ring).
  rewrite coords_sub. unfold seen', depth', off_x', off_y'. fold beside.
  apply vec_eq; simpl; field; lra.
Qed.
Lemma coords_forward : coords forward = V 0 0 1.
Proof.
  rewrite <- (coords_from (V 0 0 1)). f_equal. apply vec_eq; unfold from, vadd, vscale; simpl; ring.
Qed.

Theorem parallel_edge a b :
  edge (Ray oh forward) a b = volume * (width * height) * det (seen' a) (seen' b) (V x y 1).
Proof.
  rewrite edge_other; simpl.
  transitivity (det (vsub a oh) (vsub b oh) forward).
  { unfold det, dot, cross, vsub; simpl; ring. }
  rewrite det_coords, coords_forward, !coords_beside.
  unfold det, dot, cross, vsub; simpl; ring.
Qed.

Theorem parallel_volume a b c :
  denominator (Ray oh forward) (Triangle a b c) =
  volume * (width * height) * det (seen' a) (seen' b) (seen' c).
Proof.
  rewrite denominator_sum; simpl. rewrite !parallel_edge.
  unfold det, dot, cross; simpl; ring.
Qed.

(** t = (e_bc t_a + e_ca t_b + e_ab t_c) / T. *)
Theorem parallel_depth a b c (r := Ray oh forward) (tri := Triangle a b c) :
  denominator r tri <> 0 ->
  depth r tri =
  (det (seen' b) (seen' c) (V x y 1) * depth' a + det (seen' c) (seen' a) (V x y 1) * depth' b +
   det (seen' a) (seen' b) (V x y 1) * depth' c) / det (seen' a) (seen' b) (seen' c).
Proof.
  intros D. unfold depth, tri in *. rewrite parallel_volume in *.
  assert (N : numerator r (Triangle a b c) = volume * (width * height) *
    (det (seen' b) (seen' c) (V x y 1) * depth' a + det (seen' c) (seen' a) (V x y 1) * depth' b +
     det (seen' a) (seen' b) (V x y 1) * depth' c)).
  { transitivity (det (vsub a oh) (vsub b oh) (vsub c oh)).
    { unfold numerator, normal, det, dot, cross, vsub; simpl; ring. }
    rewrite det_coords, !coords_beside. unfold det, dot, cross, vsub; simpl; ring. }
  rewrite N. set (T := det (seen' a) (seen' b) (seen' c)) in *.
  assert (T <> 0). { intros Z. apply D. rewrite Z. ring. }
  field. repeat split; try lra; assumption.
Qed.

Lemma seen_at' t : seen' (at_ (Ray oh forward) t) = V x y 1 /\ depth' (at_ (Ray oh forward) t) = t.
Proof.
  assert (E : coords (vsub (at_ (Ray oh forward) t) o) = vadd beside (V 0 0 t)).
  { unfold at_, beside; simpl. replace (vsub (vadd oh (vscale t forward)) o) with
      (vadd (vsub oh o) (vscale t forward)) by (apply vec_eq; simpl; ring).
    rewrite coords_add, coords_scale, coords_forward. apply vec_eq; simpl; ring. }
  split.
  - unfold seen'. rewrite E. unfold off_x', off_y'. apply vec_eq; simpl; try reflexivity; field; lra.
  - unfold depth'. rewrite E. simpl. ring.
Qed.

Lemma seen_mean' i j k a b c : i + j + k = 1 ->
  let m := vadd (vscale i a) (vadd (vscale j b) (vscale k c)) in
  seen' m = vadd (vscale i (seen' a)) (vadd (vscale j (seen' b)) (vscale k (seen' c))) /\
  depth' m = i * depth' a + j * depth' b + k * depth' c.
Proof.
  intros H m.
  assert (E : coords (vsub m o) = vadd (vscale i (coords (vsub a o)))
    (vadd (vscale j (coords (vsub b o))) (vscale k (coords (vsub c o))))).
  { rewrite <- !coords_scale, <- !coords_add. f_equal. unfold m.
    replace i with (1 - j - k) by lra. apply vec_eq; unfold vsub, vadd, vscale; simpl; ring. }
  split.
  - unfold seen'. rewrite E. replace i with (1 - j - k) by lra.
    unfold off_x', off_y'. apply vec_eq; simpl; try ring; field; lra.
  - unfold depth'. rewrite E. replace i with (1 - j - k) by lra. simpl. ring.
Qed.
End Parallel.
End Camera.
