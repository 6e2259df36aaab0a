(** Why no pixel outside a triangle's box has a ray that meets it; what [nearest] says.

    [enter] in [film.py]. Every corner that is before the eye has a range of pixels, widened by its
    error; a triangle's box is the least of the lower ends and the greatest of the upper ones. What
    [place] and [weight] prove comes in as a hypothesis: [off_p] and [off_w]; [Film.v] has it. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Camera Place.
Open Scope R_scope.

Lemma rnd_at_least x : 0 <= x -> x - u * x - eta <= rnd x.
Proof. intros H. generalize (Rabs_le_inv _ _ (rnd_err x)). rewrite (Rabs_pos_eq x H). lra. Qed.
Lemma rnd_at_most x : 0 <= x -> rnd x <= x + u * x + eta.
Proof. intros H. generalize (Rabs_le_inv _ _ (rnd_err x)). rewrite (Rabs_pos_eq x H). lra. Qed.

(** ** A corner, along one axis of n pixels; `far` is at least twice as many *)
Section Corner.
Variables constant slope weight size far : R. (* floats *)
Variable K : R. (* the float 1.01 *)
Hypothesis K_value : 10099 / 10000 <= K.

(** [margin], as it comes about in [enter]. *)
Definition margin_0 := rnd (constant + rnd (slope * size)).
Definition margin_1 := rnd (margin_0 + rnd (rnd (far * weight) * size)).
Definition margin_2 (w : R) := rnd (K * rnd (margin_1 / w)).
Definition margin_3 (w : R) := rnd (margin_2 w + / 2).
Definition clip (x least most : R) := Rmin (Rmax x least) most.
Definition lowest (p w n : R) := clip (IZR (Zceil (rnd (rnd (p / w) - margin_3 w)))) (- 2) (n + 2).
(** Stored with the other sign, so that the minimum over the corners serves both ends. *)
Definition highest (p w n : R) := clip (rnd (1 - IZR (Zfloor (rnd (rnd (p / w) + margin_3 w))))) (- n - 2) 2.

Variables p w p' w' : R. (* as computed; and as the ray sees the corner *)
Definition place := constant + slope * size.
Hypothesis off_p : near p p' (92 / 100 * place).
Hypothesis off_w : near w w' (92 / 100 * (weight * size)).
Hypothesis w_pos : 0 < w.
Hypothesis w_some : eta <= u * w / 1000.
Variable n : Z.
Hypothesis n_pixels : (1 <= n < 2 ^ 40)%Z.
Hypothesis far_enough : 2 * IZR n <= far.
Hypothesis constant_pos : 0 <= constant.
Hypothesis slope_pos : 0 <= slope.
Hypothesis size_pos : 0 <= size.
Hypothesis weight_some : weight = 0 \/ bpow radix2 (-100) <= weight.
(** [film] in [place] is 128 u (width + height), and w at most the spread times the size. *)
Hypothesis place_some : 50 * u * far * w <= place.

Definition M := (place + far * weight * size) / w.

Lemma n_real : 1 <= IZR n. Proof. apply IZR_le. lia. Qed.
Lemma far_weight : 0 <= far * weight.
Proof.
  assert (N := n_real). apply Rmult_le_pos; [lra|].
  destruct weight_some as [->|H]; [lra | generalize (bpow_gt_0 radix2 (-100)); lra].
Qed.
Lemma weight_size : 0 <= weight * size.
Proof.
  clear - size_pos weight_some.
  apply Rmult_le_pos; [|exact size_pos].
  destruct weight_some as [->|Hw]; [lra | generalize (bpow_gt_0 radix2 (-100)); lra].
Qed.
Lemma M_some : 100 * u * IZR n <= M.
Proof.
  unfold M. apply Rmult_le_reg_r with w; [exact w_pos|].
  replace ((place + far * weight * size) / w * w) with (place + far * weight * size) by (field; lra).
  assert (0 <= far * weight * size) by (apply Rmult_le_pos; [apply far_weight | exact size_pos]).
  assert (u * w * (2 * IZR n) <= u * w * far).
  { apply Rmult_le_compat_l; [apply Rmult_le_pos; [apply Rlt_le, u_pos | lra] | exact far_enough]. }
  generalize place_some. lra.
Qed.
Lemma M_far : 50 * u * far <= M.
Proof.
  unfold M. apply Rmult_le_reg_r with w; [exact w_pos|].
  replace ((place + far * weight * size) / w * w) with (place + far * weight * size) by (field; lra).
  assert (0 <= far * weight * size) by (apply Rmult_le_pos; [apply far_weight | exact size_pos]).
  generalize place_some. lra.
Qed.
Lemma margin_1_least : (place + far * weight * size) * (1 - 5 * u) - 5 * eta <= margin_1.
Proof.
  assert (P := u_pos). assert (T := u_tiny). assert (E := eta_pos). assert (F := far_weight).
  assert (A : 0 <= slope * size) by now apply Rmult_le_pos.
  assert (B : slope * size * (1 - u) - eta <= rnd (slope * size)) by (generalize (rnd_at_least _ A); lra).
  assert (C : (constant + slope * size) * (1 - 2 * u) - 2 * eta <= margin_0).
  { unfold margin_0. assert (R0 := rnd_pos _ A).
    generalize (rnd_at_least (constant + rnd (slope * size)) ltac:(lra)).
    assert ((1 - u) * (slope * size * (1 - u) - eta) <= (1 - u) * rnd (slope * size)) by (apply Rmult_le_compat_l; lra).
    assert (0 <= u * constant) by (apply Rmult_le_pos; lra).
    assert (0 <= u * (u * (slope * size))) by (repeat (lra || apply Rmult_le_pos)).
    assert (0 <= u * eta) by (apply Rmult_le_pos; lra). lra. }
  assert (D : far * weight * (1 - u) <= rnd (far * weight)).
  { destruct weight_some as [Z|H]; [rewrite Z, !Rmult_0_r, rnd_0; lra|].
    assert (N := n_real).
    assert (1 * bpow radix2 (-100) <= far * weight) by (apply Rmult_le_compat; try lra; apply bpow_ge_0).
    assert (bpow radix2 (-1022) <= bpow radix2 (-100)) by (apply bpow_le; lia).
    generalize (Rabs_le_inv _ _ (rnd_err_rel (far * weight) ltac:(rewrite Rabs_pos_eq; lra))).
    rewrite (Rabs_pos_eq (far * weight)) by lra. lra. }
  assert (G0 : 0 <= rnd (far * weight)) by now apply rnd_pos.
  assert (G1 : 0 <= rnd (far * weight) * size) by now apply Rmult_le_pos.
  assert (G2 : far * weight * size * (1 - 2 * u) - eta <= rnd (rnd (far * weight) * size)).
  { generalize (rnd_at_least _ G1). 
    assert (far * weight * (1 - u) * size <= rnd (far * weight) * size) by (apply Rmult_le_compat_r; lra).
    assert (0 <= u * (u * (far * weight * size))) by (repeat (lra || apply Rmult_le_pos)).
    assert ((1 - u) * (far * weight * (1 - u) * size) <= (1 - u) * (rnd (far * weight) * size)) by (apply Rmult_le_compat_l; lra).
    lra. }
  unfold margin_1, place. set (a := constant + slope * size) in *. set (b := far * weight * size) in *.
  assert (0 <= a) by (unfold a; lra). assert (0 <= b) by (unfold b; now apply Rmult_le_pos).
  assert (0 <= margin_0) by (unfold margin_0; apply rnd_pos; generalize (rnd_pos _ A); lra).
  assert (0 <= rnd (rnd (far * weight) * size)) by now apply rnd_pos.
  generalize (rnd_at_least (margin_0 + rnd (rnd (far * weight) * size)) ltac:(lra)).
  assert ((1 - u) * (a * (1 - 2 * u) - 2 * eta + (b * (1 - 2 * u) - eta)) <= (1 - u) * (margin_0 + rnd (rnd (far * weight) * size)))
    by (apply Rmult_le_compat_l; lra).
  assert (0 <= u * (u * (a + b))) by (repeat (lra || apply Rmult_le_pos)).
  assert (0 <= u * (a + b)) by (repeat (lra || apply Rmult_le_pos)).
  assert (0 <= u * eta) by (apply Rmult_le_pos; lra). lra.
Qed.
Lemma margin_2_least : 1005 / 1000 * M <= margin_2 w.
Proof.
  assert (P := u_pos). assert (T := u_tiny). assert (E := eta_pos). assert (N := n_real).
  assert (A := margin_1_least). assert (B := M_some).
  assert (P1 : 100 * u * 1 <= 100 * u * IZR n) by (apply Rmult_le_compat_l; lra).
  assert (k0 : 0 < / w) by now apply Rinv_0_lt_compat.
  assert (C : M * (1 - 5 * u) - 5 * (u / 1000) <= margin_1 / w).
  { apply Rle_trans with (((place + far * weight * size) * (1 - 5 * u) - 5 * (u * w / 1000)) / w).
    - right. unfold M. field. lra.
    - unfold Rdiv at 1. apply Rmult_le_compat_r; lra. }
  assert (E1 := eta_u6).
  assert (uM : u * M <= / 1000000 * M) by (apply Rmult_le_compat_r; lra).
  assert (D : 999 / 1000 * M <= margin_1 / w) by lra.
  assert (D' : 9998 / 10000 * M <= margin_1 / w) by lra.
  assert (F : 9997 / 10000 * M <= rnd (margin_1 / w)).
  { generalize (rnd_at_least (margin_1 / w) ltac:(lra)).
    assert (u * (margin_1 / w) <= / 1000000 * (margin_1 / w)) by (apply Rmult_le_compat_r; lra). lra. }
  set (q := rnd (margin_1 / w)) in *. unfold margin_2. fold q.
  assert (G : 10099 / 10000 * (9997 / 10000 * M) <= K * q) by (apply Rmult_le_compat; lra).
  generalize (rnd_at_least (K * q) ltac:(lra)).
  assert (u * (K * q) <= / 1000000 * (K * q)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Variable i : Z.
Hypothesis i_pixel : (0 <= i < n)%Z.
Notation x := (IZR i + / 2). (* the pixel's centre *)

(** Where the corner truly is not beyond the pixel's centre, the pixel is not before its range. *)
Lemma at_least : p' <= x * w' -> lowest p w (IZR n) <= IZR i.
Proof.
  intros H. assert (P := u_pos). assert (T := u_tiny). assert (E := eta_pos). assert (N := n_real).
  assert (I0 : 0 <= IZR i) by (apply IZR_le; lia). assert (I1 : IZR i + 1 <= IZR n) by (rewrite <- plus_IZR; apply IZR_le; lia).
  assert (B := M_some). assert (D := margin_2_least).
  assert (P1 : u * 1 <= u * IZR n) by (apply Rmult_le_compat_l; lra).
  apply Rabs_le_inv in off_p, off_w.
  assert (Ws := weight_size).
  assert (Q : p / w <= x + 92 / 100 * M).
  { apply Rmult_le_reg_r with w; [exact w_pos|]. unfold M.
    replace (p / w * w) with p by (field; lra).
    replace ((x + 92 / 100 * ((place + far * weight * size) / w)) * w) with (x * w + 92 / 100 * (place + far * (weight * size))) by (field; lra).
    assert (x * w' <= x * (w + 92 / 100 * (weight * size))) by (apply Rmult_le_compat_l; lra).
    assert (x * (weight * size) <= far * (weight * size)) by (apply Rmult_le_compat_r; lra). lra. }
  apply rnd_le in Q. assert (Q' := rnd_at_most (x + 92 / 100 * M) ltac:(lra)).
  assert (R3 := rnd_at_least (margin_2 w + / 2) ltac:(lra)). fold (margin_3 w) in R3.
  assert (uM : u * M <= / 1000000 * M) by (apply Rmult_le_compat_r; lra).
  assert (um : u * margin_2 w <= / 1000000 * margin_2 w) by (apply Rmult_le_compat_r; lra).
  assert (ui : u * IZR i <= u * IZR n) by (apply Rmult_le_compat_l; lra).
  assert (eta_1 := eta_u6).
  assert (F : rnd (p / w) - margin_3 w <= IZR i) by lra.
  apply rnd_le in F. rewrite (rnd_id (IZR i)) in F by (apply int_float; lia).
  apply Zceil_glb, IZR_le in F.
  unfold lowest, clip. eapply Rle_trans; [apply Rmin_l|]. apply Rmax_lub; lra.
Qed.
Lemma at_most : x * w' <= p' -> highest p w (IZR n) <= - IZR i.
Proof.
  intros H. assert (P := u_pos). assert (T := u_tiny). assert (E := eta_pos). assert (N := n_real).
  assert (I0 : 0 <= IZR i) by (apply IZR_le; lia). assert (I1 : IZR i + 1 <= IZR n) by (rewrite <- plus_IZR; apply IZR_le; lia).
  assert (B := M_some). assert (D := margin_2_least).
  assert (P1 : u * 1 <= u * IZR n) by (apply Rmult_le_compat_l; lra).
  apply Rabs_le_inv in off_p, off_w.
  assert (Ws := weight_size).
  assert (Q : x - 92 / 100 * M <= p / w).
  { apply Rmult_le_reg_r with w; [exact w_pos|]. unfold M.
    replace (p / w * w) with p by (field; lra).
    replace ((x - 92 / 100 * ((place + far * weight * size) / w)) * w) with (x * w - 92 / 100 * (place + far * (weight * size))) by (field; lra).
    assert (x * (w - 92 / 100 * (weight * size)) <= x * w') by (apply Rmult_le_compat_l; lra).
    assert (x * (weight * size) <= far * (weight * size)) by (apply Rmult_le_compat_r; lra). lra. }
  apply rnd_le in Q. assert (Q' := Rabs_le_inv _ _ (rnd_err (x - 92 / 100 * M))).
  assert (R3 := rnd_at_least (margin_2 w + / 2) ltac:(lra)). fold (margin_3 w) in R3.
  assert (uM : u * M <= / 1000000 * M) by (apply Rmult_le_compat_r; lra).
  assert (um : u * margin_2 w <= / 1000000 * margin_2 w) by (apply Rmult_le_compat_r; lra).
  assert (ui : u * Rabs (x - 92 / 100 * M) <= u * (IZR n + M)).
  { apply Rmult_le_compat_l; [lra|]. apply Rabs_le. lra. }
  assert (eta_1 := eta_u6).
  assert (F : IZR (i + 1) <= rnd (p / w) + margin_3 w) by (rewrite plus_IZR; lra).
  apply rnd_le in F. rewrite (rnd_id (IZR (i + 1))) in F by (apply int_float; lia).
  apply Zfloor_lub, IZR_le in F. set (z := IZR (Zfloor _)) in F. unfold highest. fold z.
  assert (G : 1 - z <= IZR (- i)) by (rewrite opp_IZR, plus_IZR in *; lra).
  apply rnd_le in G. rewrite (rnd_id (IZR (- i))) in G by (apply int_float; lia). rewrite opp_IZR in G.
  unfold clip. eapply Rle_trans; [apply Rmin_l|]. apply Rmax_lub; lra.
Qed.
End Corner.

(** ** A triangle: what the ray meets is a mean of its corners *)

Lemma meets_mean r s : meets r s -> exists i j k, 0 <= i /\ 0 <= j /\ 0 <= k /\ i + j + k = 1 /\
  at_ r (Geometry.depth r s) = vadd (vscale i (ca s)) (vadd (vscale j (cb s)) (vscale k (cc s))).
Proof.
  intros [D H]. assert (E := denominator_sum r s).
  exists (edge r (cb s) (cc s) / denominator r s), (edge r (cc s) (ca s) / denominator r s),
    (edge r (ca s) (cb s) / denominator r s).
  assert (Q : forall e, (0 <= e /\ 0 < denominator r s) \/ (e <= 0 /\ denominator r s < 0) -> 0 <= e / denominator r s).
  { intros e [[A B]|[A B]].
    - apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra].
    - replace (e / denominator r s) with ((- e) * / (- denominator r s)) by (field; lra).
      apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra]. }
  repeat split; try (apply Q; destruct H as [H|H]; [left | right]; lra).
  - rewrite E. field. lra.
  - exact (meets_at r s D).
Qed.
Lemma one_not_above i j k a b c : 0 <= i -> 0 <= j -> 0 <= k -> i + j + k = 1 ->
  i * a + j * b + k * c <= 0 -> a <= 0 \/ b <= 0 \/ c <= 0.
Proof.
  intros. destruct (Rle_or_lt a 0); [auto|]. destruct (Rle_or_lt b 0); [auto|].
  destruct (Rle_or_lt c 0); [auto|]. exfalso.
  assert (0 <= i * a /\ 0 <= j * b /\ 0 <= k * c) by (repeat split; apply Rmult_le_pos; lra).
  assert (i * a = 0 /\ j * b = 0 /\ k * c = 0) as [A [B C]] by lra.
  apply Rmult_integral in A, B, C. lra.
Qed.

Section Triangle.
Variables right up forward : vec.
Hypothesis solid : volume right up forward <> 0.
Variables left bottom width height dx dy : R.
Hypothesis width_pos : 0 < width.
Hypothesis height_pos : 0 < height.
Variables (o d : vec) (x y s : R).
Hypothesis s_pos : 0 < s.
Hypothesis ahead : 0 < ray_depth right up forward d.
Variables a b c : vec.
Notation see := (seen right up forward left bottom width height dx dy o d x y s).

(** Corners on both sides of the pixel's centre, or on it; and one not behind what is met. *)
Theorem corners_around : meets (Ray o d) (Triangle a b c) ->
  let f v := vx (see v) - x * vz (see v) in let g v := vy (see v) - y * vz (see v) in
  let behind v := vz (see v) - Geometry.depth (Ray o d) (Triangle a b c) * s * ray_depth right up forward d in
  (f a <= 0 \/ f b <= 0 \/ f c <= 0) /\ (0 <= f a \/ 0 <= f b \/ 0 <= f c) /\
  (g a <= 0 \/ g b <= 0 \/ g c <= 0) /\ (0 <= g a \/ 0 <= g b \/ 0 <= g c) /\
  (behind a <= 0 \/ behind b <= 0 \/ behind c <= 0).
Proof.
  intros H f g behind. destruct (meets_mean _ _ H) as [i [j [k [I [J [K [One E]]]]]]].
  set (t := Geometry.depth _ _) in *. simpl in E.
  assert (F := seen_at right up forward left bottom width height dx dy width_pos height_pos o d x y s ahead t).
  rewrite E, (seen_mean right up forward left bottom width height dx dy width_pos height_pos o d x y s i j k a b c One) in F.
  assert (Fx := f_equal vx F). assert (Fy := f_equal vy F). assert (Fz := f_equal vz F).
  cbn [vadd vscale vx vy vz] in Fx, Fy, Fz.
  assert (X : i * f a + j * f b + k * f c = 0).
  { unfold f. transitivity ((i * vx (see a) + (j * vx (see b) + k * vx (see c))) - x * (i * vz (see a) + (j * vz (see b) + k * vz (see c)))); [ring|].
    rewrite Fx, Fz. ring. }
  assert (Y : i * g a + j * g b + k * g c = 0).
  { unfold g. transitivity ((i * vy (see a) + (j * vy (see b) + k * vy (see c))) - y * (i * vz (see a) + (j * vz (see b) + k * vz (see c)))); [ring|].
    rewrite Fy, Fz. ring. }
  assert (W : i * behind a + j * behind b + k * behind c = 0).
  { unfold behind. transitivity ((i * vz (see a) + (j * vz (see b) + k * vz (see c))) - (i + j + k) * (t * s * ray_depth right up forward d)); [ring|].
    rewrite Fz, One. ring. }
  assert (O : forall h : vec -> R, i * h a + j * h b + k * h c = 0 -> 0 <= h a \/ 0 <= h b \/ 0 <= h c).
  { intros h Hh. destruct (one_not_above i j k (- h a) (- h b) (- h c) I J K One ltac:(lra)) as [?|[?|?]]; lra. }
  split; [|split; [|split; [|split]]]; auto; apply (one_not_above i j k); auto; lra.
Qed.
End Triangle.

(** ** The most that the nearness of what is seen can be *)

(** [(1 + 2.0**-48 + 2 * self.ray_error) / np.maximum(depth - self.weight * size, clip_start)]. *)
Definition nearest (depth size weight ray_error clip_start : R) :=
  rnd (rnd (rnd (1 + bpow radix2 (-48)) + rnd (2 * ray_error)) /
       Rmax (rnd (depth - rnd (weight * size))) clip_start).

(** Of a perspective ray's hit at t, and a corner that is not behind it; [factor] as in
    [nearness_factor]. *)
Theorem nearest_holds depth depth' size weight ray_error clip_start t factor :
  near depth depth' (92 / 100 * (weight * size)) -> bpow radix2 (-1022) <= weight * size ->
  0 <= ray_error <= / 4 -> Rabs (factor - 1) <= 2 * ray_error ->
  bpow radix2 (-1000) <= clip_start <= t -> t <= bpow radix2 1000 -> depth' <= t * factor ->
  / t <= nearest depth size weight ray_error clip_start.
Proof.
  intros D Ws RE F [C1 C2] T1 D'. assert (P := u_pos). assert (T := u_tiny). assert (E := eta_pos).
  apply Rabs_le_inv in F, D. assert (C0 := bpow_gt_0 radix2 (-1000)). assert (t0 : 0 < t) by lra.
  assert (Ew : 0 < weight * size) by (generalize (bpow_gt_0 radix2 (-1022)); lra).
  assert (W := Rabs_le_inv _ _ (rnd_err_rel (weight * size) ltac:(rewrite Rabs_pos_eq; lra))).
  rewrite (Rabs_pos_eq (weight * size)) in W by lra.
  assert (u * (weight * size) <= / 1000000 * (weight * size)) by (apply Rmult_le_compat_r; lra).
  assert (B1 : rnd (depth - rnd (weight * size)) <= rnd (t * factor)) by (apply rnd_le; lra).
  assert (TF : t * / 2 <= t * factor <= t * (1 + 2 * ray_error)).
  { split; apply Rmult_le_compat_l; lra. }
  assert (eta_t : eta <= u * (t * factor)).
  { apply Rle_trans with (u * (bpow radix2 (-1000) * / 2)).
    - unfold eta, u. replace (-1074)%Z with (-22 + (-52 + -1000))%Z by reflexivity. rewrite !bpow_plus.
      assert (bpow radix2 (-22) <= / 4).
      { apply Rle_trans with (bpow radix2 (-2)); [apply bpow_le; lia | simpl; lra]. }
      assert (0 < bpow radix2 (-52) * bpow radix2 (-1000)) by (apply Rmult_lt_0_compat; apply bpow_gt_0). nra.
    - apply Rmult_le_compat_l; lra. }
  assert (B2 := rnd_at_most (t * factor) ltac:(lra)).
  set (before := Rmax (rnd (depth - rnd (weight * size))) clip_start).
  assert (u * (t * factor) <= u * (t * (1 + 2 * ray_error))) by (apply Rmult_le_compat_l; lra).
  assert (B0 : 0 < before) by (unfold before; eapply Rlt_le_trans; [|apply Rmax_r]; lra).
  assert (tr : 0 <= t * ray_error) by (apply Rmult_le_pos; lra).
  assert (0 <= u * (t * (1 + 2 * ray_error))) by (repeat (lra || apply Rmult_le_pos)).
  assert (B : before <= (1 + 2 * u) * (t * (1 + 2 * ray_error))) by (unfold before; apply Rmax_lub; lra).
  set (num := rnd (rnd (1 + bpow radix2 (-48)) + rnd (2 * ray_error))).
  assert (N : (1 + 2 * ray_error) * (1 + 18 * u) <= num).
  { assert (V : bpow radix2 (-48) = 32 * u) by (rewrite u_value; simpl; lra).
    assert (eta_1 := eta_u6).
    assert (uu : u * u <= / 1000000 * u) by (apply Rmult_le_compat_r; lra).
    assert (ur : u * ray_error <= u * / 4) by (apply Rmult_le_compat_l; lra).
    assert (N1 := rnd_at_least (1 + bpow radix2 (-48)) ltac:(rewrite V; lra)). rewrite V in N1.
    assert (N2 := rnd_at_least (2 * ray_error) ltac:(lra)).
    assert (N3 : 1 + 2 * ray_error + 29 * u <= rnd (1 + 32 * u) + rnd (2 * ray_error)) by lra.
    apply rnd_le in N3. rewrite <- V in N3. fold num in N3.
    generalize (rnd_at_least (1 + 2 * ray_error + 29 * u) ltac:(lra)). lra. }
  assert (Q : (1 + 15 * u) * / t <= num / before).
  { apply Rmult_le_reg_r with (before * t); [now apply Rmult_lt_0_compat|].
    replace ((1 + 15 * u) * / t * (before * t)) with ((1 + 15 * u) * before) by (field; lra).
    replace (num / before * (before * t)) with (num * t) by (field; lra).
    apply Rle_trans with ((1 + 2 * ray_error) * (1 + 18 * u) * t); [|apply Rmult_le_compat_r; lra].
    apply Rle_trans with ((1 + 15 * u) * ((1 + 2 * u) * (t * (1 + 2 * ray_error)))); [apply Rmult_le_compat_l; lra|].
    replace ((1 + 2 * ray_error) * (1 + 18 * u) * t) with ((1 + 18 * u) * (t * (1 + 2 * ray_error))) by ring.
    rewrite <- Rmult_assoc. apply Rmult_le_compat_r; [lra|].
    assert (u * u <= / 1000000 * u) by (apply Rmult_le_compat_r; lra). lra. }
  assert (It : bpow radix2 (-1000) <= / t).
  { replace (-1000)%Z with (- (1000))%Z by reflexivity. rewrite bpow_opp. apply Rinv_le; lra. }
  assert (eta_i : eta <= u * / t).
  { apply Rle_trans with (u * bpow radix2 (-1000)); [|apply Rmult_le_compat_l; lra].
    unfold eta, u. replace (-1074)%Z with (-22 + (-52 + -1000))%Z by reflexivity. rewrite !bpow_plus.
    assert (bpow radix2 (-22) <= 1) by (apply (bpow_le radix2 (-22) 0); lia).
    assert (0 < bpow radix2 (-52) * bpow radix2 (-1000)) by (apply Rmult_lt_0_compat; apply bpow_gt_0). nra. }
  unfold nearest. fold before num. apply rnd_le in Q. eapply Rle_trans; [|exact Q].
  assert (0 < u * / t) by (apply Rmult_lt_0_compat; lra).
  generalize (rnd_at_least ((1 + 15 * u) * / t) ltac:(lra)).
  assert (u * (u * / t) <= / 1000000 * (u * / t)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(** Orthographic: [(constant + slope * size) - depth], with those of [depth_error]. *)
Definition nearest' (depth size constant slope : R) := rnd (rnd (constant + rnd (slope * size)) - depth).

Theorem nearest_holds' depth depth' size constant slope t (own := constant + slope * size) :
  0 <= constant -> 0 <= slope * size -> near depth depth' (92 / 100 * own) ->
  100 * (u * Rabs depth) <= own -> 1000 * eta <= own -> depth' <= t -> - t <= nearest' depth size constant slope.
Proof.
  intros C S D U Eo Ht. assert (P := u_pos). assert (T := u_tiny). assert (E := eta_pos).
  apply Rabs_le_inv in D. unfold nearest'. set (m := rnd (constant + rnd (slope * size))).
  assert (uo : u * own <= / 1000000 * own) by (apply Rmult_le_compat_r; lra).
  assert (R0 := rnd_pos _ S). 
  assert (A1 := rnd_at_least _ S). assert (A2 := rnd_at_most _ S).
  assert (us : 0 <= u * (slope * size)) by (apply Rmult_le_pos; lra).
  assert (uc : 0 <= u * constant) by (apply Rmult_le_pos; lra).
  assert (A3 := rnd_at_least (constant + rnd (slope * size)) ltac:(lra)). fold m in A3.
  assert (A4 := rnd_at_most (constant + rnd (slope * size)) ltac:(lra)). fold m in A4.
  assert (Sum : Rabs (constant + rnd (slope * size) - own) <= / 500 * own).
  { unfold own in *. apply Rabs_le. lra. }
  apply Rabs_le_inv in Sum.
  assert (u * (constant + rnd (slope * size)) <= u * (2 * own)) by (apply Rmult_le_compat_l; lra).
  assert (Bm : 99 / 100 * own <= m <= 101 / 100 * own) by lra.
  assert (R := Rabs_le_inv _ _ (rnd_err (m - depth))).
  assert (u * Rabs (m - depth) <= u * (101 / 100 * own + Rabs depth)).
  { apply Rmult_le_compat_l; [lra|]. apply tri; [rewrite Rabs_pos_eq; lra | apply Rle_refl]. }
  lra.
Qed.
