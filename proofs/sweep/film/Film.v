(** How far rounding moves vertices and rays on the film: why [place], [weight], [ray_error] and
    [depth_error] of [film.py] bound it.

    S is [_spread], the sum of |.| of the dual axes, and Z a vertex's [size]: their product is not less
    than |w|, and some u S Z is what the roundings of a coordinate come to. That the dual axes
    themselves are off by at most 100 u S is a hypothesis here ([dual_near]). *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Camera Place.
Open Scope R_scope.

Section Stored.
Variables right up forward o : vec.
Hypothesis solid : volume right up forward <> 0.
Hypothesis axes_float : floats right /\ floats up /\ floats forward /\ floats o.
Variable m : R. (* the largest |.| of the axes' components *)
Hypothesis axes_within : within right m /\ within up m /\ within forward m.
Hypothesis m_some : / 4 <= m.

(** The dual axes as computed; S is the sum of their |.| as computed; they are near the exact ones,
    times a factor s that all share. *)
Variables dr du df : vec.
Variables s S : R.
Hypothesis dual_float : floats dr /\ floats du /\ floats df.
Hypothesis dual_near :
  off_by s dr (dual_right right up forward) <= 100 * (u * S) /\
  off_by s du (dual_up right up forward) <= 100 * (u * S) /\
  off_by s df (dual_depth right up forward) <= 100 * (u * S).
Hypothesis spread : L1 dr <= 1001 / 1000 * S /\ L1 du <= 1001 / 1000 * S /\ L1 df <= 1001 / 1000 * S.
Hypothesis S_some : 1 <= S.
Hypothesis s_some : Rabs (s - 1) <= / 100.

Notation Dr := (dual_right right up forward).
Notation Du := (dual_up right up forward).
Notation Df := (dual_depth right up forward).
Notation coords := (coords right up forward).

(** A vertex's coordinates ([Place.v]), of this camera. *)
Notation dual_L1 := (L1_dual s S S_some s_some).
Notation vertex_coordinate := (coordinate o (proj2 (proj2 (proj2 axes_float))) s S S_some s_some).
Notation eta_small := (eta_unit S S_some).

(** ** Perspective *)
Section Perspective.
Variables ax ay : axis.
Hypothesis ax_ok : axis_ok ax.
Hypothesis ay_ok : axis_ok ay.
Variable ray_error : R.
(** [24 * _EPS * self._spread * length]: 48 u, less what its own roundings may take. *)
Definition ray_length := m * (1 + reach ax + reach ay).
Hypothesis ray_error_enough : 47 * (u * (S * ray_length)) <= ray_error.
Hypothesis ray_error_small : ray_error <= / 4.

Variables i j dx dy : R. (* the pixel's column and row *)
Hypothesis column : in_picture ax i dx.
Hypothesis row : in_picture ay j dy.
Notation x := (window_at (start ax) (film_at i dx) (pixel ax)).
Notation y := (window_at (start ay) (film_at j dy) (pixel ay)).
Notation d := (fdirection x y right up forward).

Lemma ray_length_some : / 4 <= ray_length.
Proof. unfold ray_length. destruct ax_ok as [_ [_ A]], ay_ok as [_ [_ B]]. nra. Qed.
Lemma direction_near : within (vsub d (from right up forward (V x y 1))) (42 / 10 * (u * ray_length)).
Proof.
  destruct axes_float as [[r0 [r1 r2]] [[p0 [p1 p2]] [[f0 [f1 f2]] _]]].
  destruct axes_within as [[a0 [a1 a2]] [[b0 [b1 b2]] [c0 [c1 c2]]]].
  destruct column as [_ [_ [_ X]]], row as [_ [_ [_ Y]]].
  assert (P := u_pos). assert (E := eta_u6). assert (L := ray_length_some).
  assert (G : forall r p f, is_float r -> is_float p -> is_float f -> Rabs r <= m -> Rabs p <= m ->
    Rabs f <= m -> near (ray_part x y r p f) (x * r + y * p + 1 * f) (42 / 10 * (u * ray_length))).
  { intros r p f Fr Fp Ff Br Bp Bf. rewrite Rmult_1_l.
    eapply near_le; [apply (ray_part_near x y r p f m _ _ (rnd_float _) (rnd_float _) Fr Fp Ff X Y Br Bp)|].
    assert (u * / 4 <= u * ray_length) by (apply Rmult_le_compat_l; lra).
    assert (m * (101 / 100 * reach ax + 101 / 100 * reach ay) + Rabs f <= 101 / 100 * ray_length).
    { unfold ray_length. replace (m * (1 + reach ax + reach ay)) with (m + m * (reach ax + reach ay)) by ring.
      replace (m * (101 / 100 * reach ax + 101 / 100 * reach ay)) with (101 / 100 * (m * (reach ax + reach ay))) by field.
      lra. }
    assert (u * (m * (101 / 100 * reach ax + 101 / 100 * reach ay) + Rabs f) <= u * (101 / 100 * ray_length))
      by (apply Rmult_le_compat_l; lra). lra. }
  split; [|split]; unfold from, vadd, vscale, vsub; simpl; apply G; assumption.
Qed.
(** The stored ray, in the camera's own coordinates: (x, y, 1), but for a tenth of [ray_error]. *)
Lemma ray_near :
  near (vx (coords d)) x (ray_error / 10) /\ near (vy (coords d)) y (ray_error / 10) /\
  near (vz (coords d)) 1 (ray_error / 10).
Proof.
  assert (C : coords d = vadd (coords (vsub d (from right up forward (V x y 1)))) (V x y 1)).
  { rewrite <- (coords_from right up forward solid (V x y 1)) at 2. rewrite <- coords_add. f_equal.
    apply vec_eq; unfold vadd, vsub; simpl; ring. }
  rewrite C. assert (W := direction_near). set (D := vsub d (from right up forward (V x y 1))) in *.
  assert (P := u_pos). assert (L := ray_length_some).
  assert (G : forall d' e, off_by s d' e <= 100 * (u * S) -> L1 d' <= 1001 / 1000 * S -> forall z,
    near (dot e D + z) z (ray_error / 10)).
  { intros d' e H K z. unfold near. replace (dot e D + z - z) with (dot e D) by ring.
    eapply Rle_trans; [apply (dot_L1 _ _ _ W)|]. destruct (dual_L1 _ _ H K) as [_ B].
    assert (0 < u * ray_length) by (apply Rmult_lt_0_compat; lra).
    assert (L1 e * (42 / 10 * (u * ray_length)) <= 102 / 100 * S * (42 / 10 * (u * ray_length)))
      by (apply Rmult_le_compat_r; lra).
    assert (0 < u * (S * ray_length)) by (apply Rmult_lt_0_compat; [lra | apply Rmult_lt_0_compat; lra]).
    replace (102 / 100 * S * (42 / 10 * (u * ray_length))) with (102 / 100 * (42 / 10) * (u * (S * ray_length))) in * by ring.
    lra. }
  destruct dual_near as [N0 [N1 N2]], spread as [K0 [K1 K2]].
  unfold Camera.coords, vadd; simpl. repeat split; eapply G; eassumption.
Qed.

Lemma ray_ahead : 39 / 40 <= ray_depth right up forward d <= 41 / 40.
Proof. destruct ray_near as [_ [_ H]]. apply Rabs_le_inv in H. unfold ray_depth. lra. Qed.
(** How far the ray passes beside its pixel, along one axis; c and w are the ray's coordinates. *)
Lemma beside_pixel a k e c w : axis_ok a -> in_picture a k e ->
  near c (window_at (start a) (film_at k e) (pixel a)) (ray_error / 10) -> near w 1 (ray_error / 10) ->
  Rabs (((c - start a * w) / pixel a - e * w) / w - (k + / 2)) <=
  12 / 100 * ray_error * (1 + reach a) / pixel a + u * (Rabs (start a) / pixel a + 5 * count a).
Proof.
  intros [[W1 W2] [N R0]] [I0 [I1 [E B]]]. set (z := window_at _ _ _) in *. intros Hc Hw.
  assert (Pw : 0 < pixel a) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact W1]).
  assert (RE : 0 <= ray_error / 10) by (eapply Rle_trans; [apply Rabs_pos | exact Hw]).
  assert (W := Rabs_le_inv _ _ Hw).
  assert (F := window_near (start a) (pixel a) (count a) k e W1 I0 I1 E). fold z in F.
  replace (((c - start a * w) / pixel a - e * w) / w - (k + / 2))
    with ((c / w - (start a + (k + / 2 + e) * pixel a)) / pixel a) by (field; lra).
  unfold Rdiv at 1. rewrite Rabs_mult, (Rabs_pos_eq (/ pixel a)) by (apply Rlt_le, Rinv_0_lt_compat; lra).
  assert (G : near (c / w) z (12 / 100 * ray_error * (1 + reach a))).
  { unfold near. replace (c / w - z) with ((c - z - z * (w - 1)) / w) by (field; lra).
    unfold Rdiv at 1. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq w) by lra.
    apply Rmult_le_reg_r with w; [lra|]. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
    eapply Rle_trans; [apply tri; [exact Hc | apply prod; [exact B | exact Hw]]|].
    assert (0 <= ray_error * reach a) by (apply Rmult_le_pos; lra).
    replace (101 / 100 * reach a * (ray_error / 10)) with (101 / 1000 * (ray_error * reach a)) by field.
    replace (12 / 100 * ray_error * (1 + reach a)) with (12 / 100 * (ray_error + ray_error * reach a)) by field.
    assert (12 / 100 * (ray_error + ray_error * reach a) * (39 / 40) <= 12 / 100 * (ray_error + ray_error * reach a) * w)
      by (apply Rmult_le_compat_l; lra). lra. }
  replace (12 / 100 * ray_error * (1 + reach a) / pixel a + u * (Rabs (start a) / pixel a + 5 * count a))
    with ((12 / 100 * ray_error * (1 + reach a) + u * (Rabs (start a) + 5 * count a * pixel a)) * / pixel a) by (field; lra).
  apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra|].
  exact (near_trans _ _ _ _ _ G F).
Qed.
(** [own + film + ray] of [place], times [_spread], before its own roundings. *)
Definition slope_of (a other : axis) :=
  S * (144 * u * (1 + Rabs (start a)) / pixel a +
       128 * u * (Rabs (start a) / pixel a + count a + count other) +
       2 * ray_error * (1 + reach a) / pixel a).
Lemma along_axis a other e c w C0 w0 off Z : axis_ok a -> axis_ok other -> Rabs e <= / 2 ->
  bpow radix2 (-970) <= Z -> 0 <= ray_error ->
  near c C0 (106 * (u * (S * Z))) -> near w w0 (106 * (u * (S * Z))) ->
  Rabs C0 <= 101 / 100 * (S * Z) -> Rabs w0 <= 101 / 100 * (S * Z) ->
  Rabs off <= 12 / 100 * ray_error * (1 + reach a) / pixel a + u * (Rabs (start a) / pixel a + 5 * count a) ->
  near (film_position c w (start a) (pixel a) e) ((C0 - start a * w0) / pixel a - e * w0 - off * w0)
    (9 / 10 * (slope_of a other * Z)).
Proof.
  intros [Wa [N R0]] [_ [N' _]] E HZ RE Hc Hw Bc Bw Boff. assert (U := eta_small Z HZ).
  assert (PZ := Z_pos Z HZ). assert (P := u_pos).
  assert (Pw : 0 < pixel a) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact (proj1 Wa)]).
  eapply near_le.
  - eapply near_trans; [apply (film_place c C0 w w0 (start a) (pixel a) e (S * Z) (S * Z)); assumption |].
    unfold near. replace ((C0 - start a * w0) / pixel a - e * w0 - ((C0 - start a * w0) / pixel a - e * w0 - off * w0))
      with (off * w0) by ring.
    apply prod; [exact Boff | exact Bw].
  - set (k' := / pixel a). assert (0 < k') by now apply Rinv_0_lt_compat.
    set (l := Rabs (start a)) in *. assert (0 <= l) by apply Rabs_pos.
    set (n := S * Z) in *. assert (Pn : 0 < n) by (apply Rmult_lt_0_compat; lra).
    assert (0 < u * n) by now apply Rmult_lt_0_compat.
    assert (0 <= u * n * (l * k')) by (repeat (lra || apply Rmult_le_pos)).
    assert (0 <= u * n * k') by (repeat (lra || apply Rmult_le_pos)).
    assert (0 <= ray_error * n * ((1 + reach a) * k')) by (repeat (lra || apply Rmult_le_pos)).
    assert (u * n * 1 <= u * n * count a) by (apply Rmult_le_compat_l; [apply Rmult_le_pos|]; lra).
    assert (u * n * 1 <= u * n * count other) by (apply Rmult_le_compat_l; [apply Rmult_le_pos|]; lra).
    replace (slope_of a other * Z) with
      (144 * (u * n * k') + 272 * (u * n * (l * k')) + 128 * (u * n * count a) + 128 * (u * n * count other)
       + 2 * (ray_error * n * ((1 + reach a) * k'))).
    2: { unfold slope_of, n, k', l. field. lra. }
    replace (u * (111 * n + 112 * (l * n)) / pixel a + 55 * (u * n) +
             (12 / 100 * ray_error * (1 + reach a) / pixel a + u * (l / pixel a + 5 * count a)) * (101 / 100 * n))
      with (111 * (u * n * k') + (112 + 101 / 100) * (u * n * (l * k')) + 55 * (u * n) + 505 / 100 * (u * n * count a)
            + 1212 / 10000 * (ray_error * n * ((1 + reach a) * k'))) by (unfold k'; field; lra).
    lra.
Qed.

(** The vertex as [enter] computes it, and as this ray sees it. *)
Variables (v : vec) (Z : R).
Hypothesis v_float : floats v.
Hypothesis v_size : within (vsub v o) (1001 / 1000 * Z).
Hypothesis Z_some : bpow radix2 (-970) <= Z.
Notation at_right := (fdot dr (fsub v o)).
Notation at_up := (fdot du (fsub v o)).
Notation at_depth := (fdot df (fsub v o)). (* which is w *)
Notation seen := (seen right up forward (start ax) (start ay) (pixel ax) (pixel ay) dx dy o d (i + / 2) (j + / 2) s).

Theorem perspective_place :
  near (film_position at_right at_depth (start ax) (pixel ax) dx) (vx (seen v)) (9 / 10 * (slope_of ax ay * Z)) /\
  near (film_position at_up at_depth (start ay) (pixel ay) dy) (vy (seen v)) (9 / 10 * (slope_of ay ax * Z)) /\
  near at_depth (vz (seen v)) (9 / 10 * (128 * u * S * Z)) /\
  Rabs (vz (seen v)) <= 101 / 100 * (S * Z).
Proof.
  destruct dual_near as [N0 [N1 N2]], spread as [K0 [K1 K2]], dual_float as [F0 [F1 F2]].
  destruct (vertex_coordinate v Z v_float v_size Z_some dr Dr F0 N0 K0) as [Cr Br].
  destruct (vertex_coordinate v Z v_float v_size Z_some du Du F1 N1 K1) as [Cu Bu].
  destruct (vertex_coordinate v Z v_float v_size Z_some df Df F2 N2 K2) as [Cd Bd].
  destruct ray_near as [Rx [Ry Rz]]. assert (A := ray_ahead). unfold ray_depth in A.
  assert (RE : 0 <= ray_error) by (generalize (Rabs_pos (vz (coords d) - 1)); unfold near in Rz; lra).
  assert (Pu := u_pos). assert (PZ := Z_pos Z Z_some).
  assert (0 < u * (S * Z)) by (apply Rmult_lt_0_compat; [lra | apply Rmult_lt_0_compat; lra]).
  assert (PX : 0 < pixel ax) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact (proj1 (proj1 ax_ok))]).
  assert (PY : 0 < pixel ay) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact (proj1 (proj1 ay_ok))]).
  assert (Ex : Rabs dx <= / 2) by apply column. assert (Ey : Rabs dy <= / 2) by apply row.
  split; [|split; [|split]].
  - replace (vx (seen v)) with ((s * dot Dr (vsub v o) - start ax * (s * dot Df (vsub v o))) / pixel ax -
      dx * (s * dot Df (vsub v o)) -
      (((vx (coords d) - start ax * vz (coords d)) / pixel ax - dx * vz (coords d)) / vz (coords d) - (i + / 2)) *
      (s * dot Df (vsub v o))).
    + apply along_axis; try assumption. now apply beside_pixel.
    + unfold Camera.seen, shear, film, off_x, ray_depth, film. generalize (Camera.coords right up forward d) A.
      intros [c0 c1 c2]; simpl; intros. field. repeat split; lra.
  - replace (vy (seen v)) with ((s * dot Du (vsub v o) - start ay * (s * dot Df (vsub v o))) / pixel ay -
      dy * (s * dot Df (vsub v o)) -
      (((vy (coords d) - start ay * vz (coords d)) / pixel ay - dy * vz (coords d)) / vz (coords d) - (j + / 2)) *
      (s * dot Df (vsub v o))).
    + apply along_axis; try assumption. now apply beside_pixel.
    + unfold Camera.seen, shear, film, off_y, ray_depth, film. generalize (Camera.coords right up forward d) A.
      intros [c0 c1 c2]; simpl; intros. field. repeat split; lra.
  - eapply near_le; [exact Cd|]. replace (128 * u * S * Z) with (128 * (u * (S * Z))) by ring. lra.
  - exact Bd.
Qed.

(** The nearness has one factor more: the ray's depth, and what the dual axes have in common. *)
Hypothesis common : Rabs (s - 1) <= 18 / 10 * ray_error.
Theorem nearness_factor : Rabs (ray_depth right up forward d * s - 1) <= 2 * ray_error.
Proof.
  destruct ray_near as [_ [_ Rz]]. unfold near in Rz. fold (ray_depth right up forward d) in Rz.
  set (r := ray_depth right up forward d) in *.
  replace (r * s - 1) with ((r - 1) + r * (s - 1)) by ring.
  assert (A := ray_ahead). fold r in A.
  assert (Rabs (r * (s - 1)) <= 41 / 40 * (18 / 10 * ray_error)).
  { apply prod; [rewrite Rabs_pos_eq; lra | exact common]. }
  eapply Rle_trans; [apply Rabs_triang|]. generalize (Rabs_pos (r - 1)). lra.
Qed.
End Perspective.

(** ** Orthographic: w is 1, and the ray's error is its origin's *)
Section Parallel.
Variables ax ay : axis.
Hypothesis ax_ok : axis_ok ax.
Hypothesis ay_ok : axis_ok ay.
Hypothesis no_factor : s = 1. (* here the dual axes themselves are near those computed *)
Hypothesis S_few : S <= 200.
Variables ray_error most : R.
Hypothesis o_within : within o most.
Definition ray_length' := most + m * (reach ax + reach ay).
Hypothesis ray_error_enough : 47 * (u * (S * ray_length')) <= ray_error.

Variables i j dx dy : R.
Hypothesis column : in_picture ax i dx.
Hypothesis row : in_picture ay j dy.
Notation x := (window_at (start ax) (film_at i dx) (pixel ax)).
Notation y := (window_at (start ay) (film_at j dy) (pixel ay)).
Notation oh := (fdirection x y right up o). (* [eye + aside] *)

Lemma origin_near : within (vsub oh (vadd o (from right up forward (V x y 0)))) (41 / 10 * (u * ray_length') + 3 * eta).
Proof.
  destruct axes_float as [[r0 [r1 r2]] [[p0 [p1 p2]] [_ [o0 [o1 o2]]]]].
  destruct axes_within as [[a0 [a1 a2]] [[b0 [b1 b2]] _]]. destruct o_within as [c0 [c1 c2]].
  destruct column as [_ [_ [_ X]]], row as [_ [_ [_ Y]]].
  destruct ax_ok as [_ [_ RX]], ay_ok as [_ [_ RY]]. assert (P := u_pos).
  assert (G : forall r p f c, is_float r -> is_float p -> is_float c -> Rabs r <= m -> Rabs p <= m ->
    Rabs c <= most -> near (ray_part x y r p c) (c + (x * r + y * p + 0 * f)) (41 / 10 * (u * ray_length') + 3 * eta)).
  { intros r p f c Fr Fp Fc Br Bp Bc. replace (c + (x * r + y * p + 0 * f)) with (x * r + y * p + c) by ring.
    eapply near_le; [apply (ray_part_near x y r p c m _ _ (rnd_float _) (rnd_float _) Fr Fp Fc X Y Br Bp)|].
    assert (0 <= m * (reach ax + reach ay)) by (apply Rmult_le_pos; lra).
    assert (m * (101 / 100 * reach ax + 101 / 100 * reach ay) + Rabs c <= 101 / 100 * ray_length').
    { unfold ray_length'. replace (m * (101 / 100 * reach ax + 101 / 100 * reach ay)) with (101 / 100 * (m * (reach ax + reach ay))) by field.
      generalize (Rabs_pos c). lra. }
    assert (u * (m * (101 / 100 * reach ax + 101 / 100 * reach ay) + Rabs c) <= u * (101 / 100 * ray_length'))
      by (apply Rmult_le_compat_l; lra).
    assert (0 <= u * ray_length').
    { apply Rmult_le_pos; [lra|]. unfold ray_length'. generalize (Rabs_pos c). lra. } lra. }
  split; [|split]; unfold from, vadd, vscale, vsub; simpl; apply G; assumption.
Qed.
Lemma beside_near : let e := ray_error / 10 + 31 / 10 * (S * eta) in
  near (vx (coords (vsub oh o))) x e /\ near (vy (coords (vsub oh o))) y e /\ near (vz (coords (vsub oh o))) 0 e.
Proof.
  intros e. set (D := vsub oh (vadd o (from right up forward (V x y 0)))).
  assert (C : coords (vsub oh o) = vadd (coords D) (V x y 0)).
  { rewrite <- (coords_from right up forward solid (V x y 0)) at 1. rewrite <- coords_add. f_equal. unfold D.
    apply vec_eq; unfold vadd, vsub; simpl; ring. }
  rewrite C. assert (W := origin_near). fold D in W. assert (P := u_pos). assert (E := eta_pos).
  assert (G : forall d' e', off_by s d' e' <= 100 * (u * S) -> L1 d' <= 1001 / 1000 * S -> forall z,
    near (dot e' D + z) z e).
  { intros d' e' H K z. unfold near. replace (dot e' D + z - z) with (dot e' D) by ring.
    eapply Rle_trans; [apply (dot_L1 _ _ _ W)|]. destruct (dual_L1 _ _ H K) as [_ B].
    assert (W0 : 0 <= 41 / 10 * (u * ray_length') + 3 * eta) by (eapply Rle_trans; [apply Rabs_pos | exact (proj1 W)]).
    assert (L1 e' * (41 / 10 * (u * ray_length') + 3 * eta) <= 102 / 100 * S * (41 / 10 * (u * ray_length') + 3 * eta))
      by (apply Rmult_le_compat_r; lra).
    assert (0 < S * eta) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= u * (S * ray_length')).
    { repeat (lra || apply Rmult_le_pos). unfold ray_length'. destruct ax_ok as [_ [_ RX]], ay_ok as [_ [_ RY]].
      assert (0 <= m * (reach ax + reach ay)) by (apply Rmult_le_pos; lra).
      generalize (Rle_trans _ _ _ (Rabs_pos _) (proj1 o_within)). lra. }
    replace (102 / 100 * S * (41 / 10 * (u * ray_length') + 3 * eta))
      with (102 / 100 * (41 / 10) * (u * (S * ray_length')) + 306 / 100 * (S * eta)) in * by field.
    unfold e. lra. }
  destruct dual_near as [N0 [N1 N2]], spread as [K0 [K1 K2]].
  unfold vadd; simpl. repeat split; eapply G; eassumption.
Qed.

(** [film + 2 * self.ray_error / size] and [slope] of [place], before their own roundings. *)
Definition constant_of' (a other : axis) :=
  128 * u * (Rabs (start a) / pixel a + count a + count other) + 2 * ray_error / pixel a.
Definition slope_of' (a : axis) := 144 * u * S / pixel a.
Lemma along_axis' a other k e c C0 b Z : axis_ok a -> axis_ok other -> in_picture a k e ->
  bpow radix2 (-970) <= Z -> near c C0 (106 * (u * (S * Z))) -> Rabs C0 <= 101 / 100 * (S * Z) ->
  near b (window_at (start a) (film_at k e) (pixel a)) (ray_error / 10 + 31 / 10 * (S * eta)) -> 0 <= ray_error ->
  near (film_position c 1 (start a) (pixel a) e)
    ((C0 - start a) / pixel a - e - ((b - start a) / pixel a - e - (k + / 2)))
    (9 / 10 * (constant_of' a other + slope_of' a * Z)).
Proof.
  intros [Wa [N R0]] [_ [N' _]] [I0 [I1 [E _]]] HZ Hc Bc Hb RE. assert (U := eta_small Z HZ).
  assert (PZ := Z_pos Z HZ). assert (P := u_pos). assert (Pe := eta_pos).
  assert (Pw : 0 < pixel a) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact (proj1 Wa)]).
  assert (F := window_near (start a) (pixel a) (count a) k e (proj1 Wa) I0 I1 E).
  assert (X := near_trans _ _ _ _ _ Hb F).
  set (k' := / pixel a). assert (0 < k') by now apply Rinv_0_lt_compat.
  set (err := ray_error / 10 + 31 / 10 * (S * eta) + u * (Rabs (start a) + 5 * count a * pixel a)) in *.
  assert (Off : Rabs ((b - start a) / pixel a - e - (k + / 2)) <= err * k').
  { replace ((b - start a) / pixel a - e - (k + / 2)) with ((b - (start a + (k + / 2 + e) * pixel a)) * k')
      by (unfold k'; field; lra).
    rewrite Rabs_mult, (Rabs_pos_eq k') by lra. apply Rmult_le_compat_r; [lra | exact X]. }
  eapply near_le.
  - eapply near_trans.
    + apply (film_place c C0 1 1 (start a) (pixel a) e (S * Z) 1); try assumption.
      * unfold near. replace (1 - 1) with 0 by ring. rewrite Rabs_R0. lra.
      * rewrite Rabs_R1. lra.
      * generalize eta_u6. lra.
    + unfold near. rewrite !Rmult_1_r.
      replace ((C0 - start a) / pixel a - e - ((C0 - start a) / pixel a - e - ((b - start a) / pixel a - e - (k + / 2))))
        with ((b - start a) / pixel a - e - (k + / 2)) by ring. exact Off.
  - assert (Eta := eta_pixel _ (proj1 Wa)). unfold err.
    set (l := Rabs (start a)) in *. assert (0 <= l) by apply Rabs_pos.
    set (n := S * Z) in *. assert (Pn : 0 < n) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= u * (l * k')) by (repeat (lra || apply Rmult_le_pos)).
    assert (0 <= u * n * k') by (repeat (lra || apply Rmult_le_pos)).
    assert (0 <= ray_error * k') by (repeat (lra || apply Rmult_le_pos)).
    assert (u * 1 <= u * count a) by (apply Rmult_le_compat_l; lra).
    assert (u * 1 <= u * count other) by (apply Rmult_le_compat_l; lra).
    assert (S * eta * k' <= 50 * u).
    { apply Rle_trans with (200 * (u * pixel a / 4) * k').
      - apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat; lra.
      - right. unfold k'. field. lra. }
    replace (constant_of' a other + slope_of' a * Z) with
      (144 * (u * n * k') + 128 * (u * (l * k')) + 128 * (u * count a) + 128 * (u * count other) + 2 * (ray_error * k')).
    2: { unfold constant_of', slope_of', n, k', l. field. lra. }
    replace (u * (111 * n + 112 * (l * 1)) / pixel a + 55 * (u * 1) +
             (ray_error / 10 + 31 / 10 * (S * eta) + u * (l + 5 * count a * pixel a)) * k')
      with (111 * (u * n * k') + 113 * (u * (l * k')) + 55 * u + 5 * (u * count a)
            + / 10 * (ray_error * k') + 31 / 10 * (S * eta * k')) by (unfold k'; field; lra).
    lra.
Qed.

Variables (v : vec) (Z : R).
Hypothesis v_float : floats v.
Hypothesis v_size : within (vsub v o) (1001 / 1000 * Z).
Hypothesis Z_some : bpow radix2 (-970) <= Z.
Notation at_right := (fdot dr (fsub v o)).
Notation at_up := (fdot du (fsub v o)).
Notation at_depth := (fdot df (fsub v o)).
Notation seen' := (seen' right up forward (start ax) (start ay) (pixel ax) (pixel ay) dx dy o oh (i + / 2) (j + / 2)).

Theorem parallel_place :
  near (film_position at_right 1 (start ax) (pixel ax) dx) (vx (seen' v))
    (9 / 10 * (constant_of' ax ay + slope_of' ax * Z)) /\
  near (film_position at_up 1 (start ay) (pixel ay) dy) (vy (seen' v))
    (9 / 10 * (constant_of' ay ax + slope_of' ay * Z)) /\
  near at_depth (depth' right up forward o oh v) (9 / 10 * (2 * ray_error + 128 * u * S * Z)).
Proof.
  destruct dual_near as [N0 [N1 N2]], spread as [K0 [K1 K2]], dual_float as [F0 [F1 F2]].
  destruct (vertex_coordinate v Z v_float v_size Z_some dr Dr F0 N0 K0) as [Cr Br].
  destruct (vertex_coordinate v Z v_float v_size Z_some du Du F1 N1 K1) as [Cu Bu].
  destruct (vertex_coordinate v Z v_float v_size Z_some df Df F2 N2 K2) as [Cd Bd].
  rewrite no_factor, Rmult_1_l in Cr, Br, Cu, Bu, Cd, Bd.
  destruct beside_near as [Rx [Ry Rz]].
  assert (Pu := u_pos). assert (PZ := Z_pos Z Z_some).
  assert (RE : 0 <= ray_error).
  { eapply Rle_trans; [|exact ray_error_enough]. repeat (lra || apply Rmult_le_pos).
    unfold ray_length'. destruct ax_ok as [_ [_ RX]], ay_ok as [_ [_ RY]].
    assert (0 <= m * (reach ax + reach ay)) by (apply Rmult_le_pos; lra).
    generalize (Rle_trans _ _ _ (Rabs_pos _) (proj1 o_within)). lra. }
  split; [|split].
  - exact (along_axis' ax ay i dx _ _ _ Z ax_ok ay_ok column Z_some Cr Br Rx RE).
  - exact (along_axis' ay ax j dy _ _ _ Z ay_ok ax_ok row Z_some Cu Bu Ry RE).
  - unfold depth', beside. eapply near_le.
    + eapply near_trans with (vz (coords (vsub v o)) - 0).
      * rewrite Rminus_0_r. exact Cd.
      * apply near_sub; [apply near_refl | apply near_sym, Rz].
    + assert (U := eta_size Z Z_some). assert (S * eta <= S * (u * Z / 100)) by (apply Rmult_le_compat_l; lra).
      assert (0 < u * (S * Z)) by (apply Rmult_lt_0_compat; [lra | apply Rmult_lt_0_compat; lra]).
      replace (128 * u * S * Z) with (128 * (u * (S * Z))) by ring.
      replace (S * (u * Z / 100)) with (/ 100 * (u * (S * Z))) in * by field. lra.
Qed.
End Parallel.
End Stored.
