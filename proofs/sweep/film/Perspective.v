(** A perspective camera, from its stored numbers to boxes: what [film.py] says of vertices holds.

    Axes, position, window, pixel and corners are floats. [has_sound_axes] is [lengths] and
    [not_flat]; [ray_error_small] excludes windows so wide that a ray's direction drowns in its own
    rounding (some 2^40 times as wide as far). Nothing overflows: [rnd] has no largest float. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Camera Place Film Dual Bounds Boxes.
From Reftrace Require Import Window.
Open Scope R_scope.
Opaque rnd.

Section Perspective.
Variables right up forward o : vec.
Hypothesis axes_float : floats right /\ floats up /\ floats forward.
Hypothesis o_float : floats o.
Hypothesis lengths : dot right right <= 401 / 100 /\ dot up up <= 401 / 100 /\ dot forward forward <= 401 / 100.
Hypothesis not_flat : 1249 / 10000 <= Rabs (volume right up forward).
Variable m : R. (* [np.abs((c.right, c.up, c.forward)).max()] *)
Hypothesis axes_within : within right m /\ within up m /\ within forward m.
Hypothesis m_range : / 4 <= m <= 201 / 100.

Notation Dr := (dr right up forward).
Notation Du := (du right up forward).
Notation Df := (df right up forward).
Variable S : R. (* [_spread]: their sum, in whichever order it was added up *)
Hypothesis S_sum : near S (nine right up forward) (nine right up forward / 10000).

Variables x0 x1 y0 y1 : R. (* the window *)
Variables width height : Z.
Notation n := (IZR width).
Notation n' := (IZR height).
Hypothesis sizes : (1 <= width < 2 ^ 40)%Z /\ (1 <= height < 2 ^ 40)%Z.
Hypothesis window_ok : x0 < x1 /\ y0 < y1.
Notation ax := (window x0 x1 n).
Notation ay := (window y0 y1 n').
Hypothesis pixels : bpow radix2 (-1020) <= pixel ax <= bpow radix2 1000 /\ bpow radix2 (-1020) <= pixel ay <= bpow radix2 1000.

Definition re := ray_error S (length m (rnd (reach ax + reach ay))).
Hypothesis ray_error_small : re <= / 4.
Definition wt := weight S.
Definition slope_x := slope S (own_error x0 (pixel ax)) (film_error x0 (pixel ax) n n') (ray_part_error re (reach ax) (pixel ax)).
Definition slope_y := slope S (own_error y0 (pixel ay)) (film_error y0 (pixel ay) n n') (ray_part_error re (reach ay) (pixel ay)).
(** The second number of [place]; the first is 0. *)
Definition place_slope := Rmax (Rmax 0 slope_x) slope_y.

Notation counts := (Window.counts width height sizes).
Notation axes_ok := (Window.axes_ok x0 x1 y0 y1 width height sizes pixels).
Lemma S_some : 1 <= S. Proof. eapply k_S; try eassumption; apply m_range. Qed.

Lemma re_enough : 47 * (u * (S * ray_length m ax ay)) <= re.
Proof.
  destruct axes_ok as [[_ [_ RX]] [_ [_ RY]]]. assert (HS := S_some). assert (M := m_range).
  assert (P := u_pos). assert (E := eta_u6). assert (Pe := eta_pos). assert (T := u_tiny).
  set (r := ray_length m ax ay). set (sum := reach ax + reach ay) in *.
  assert (R : r = m + m * sum) by (unfold r, sum, ray_length; ring).
  assert (ms : 0 <= m * sum) by (apply Rmult_le_pos; unfold sum; lra).
  assert (A := lo1 sum ltac:(unfold sum; lra)).
  assert (B := lo (1 + rnd sum) (1 + (9999 / 10000 * sum - eta)) ltac:(unfold sum in *; lra) ltac:(lra)).
  assert (B' : 9997 / 10000 * (1 + sum) <= rnd (1 + rnd sum)) by (unfold sum in *; lra).
  assert (C : m * (9997 / 10000 * (1 + sum)) <= m * rnd (1 + rnd sum)) by (apply Rmult_le_compat_l; lra).
  assert (D := lo (m * rnd (1 + rnd sum)) (9997 / 10000 * (m + m * sum)) ltac:(lra) ltac:(lra)).
  assert (L : 9995 / 10000 * r - 10 * eta <= length m (rnd sum)) by (unfold length; lra).
  assert (G := error_of_length S (length m (rnd sum)) r HS ltac:(lra) ltac:(lra) ltac:(lra)).
  unfold re. fold sum. 
  assert (S * / 4 <= S * r) by (apply Rmult_le_compat_l; lra).
  assert (u * (S * / 4) <= u * (S * r)) by (apply Rmult_le_compat_l; lra).
  assert (u * 1 <= u * S) by (apply Rmult_le_compat_l; lra).
  assert (u * (S * eta) <= u * S * / 1000000).
  { rewrite <- Rmult_assoc. apply Rmult_le_compat_l; [|lra]. apply Rmult_le_pos; lra. } lra.
Qed.

Lemma re_pos : 0 <= re.
Proof.
  eapply Rle_trans; [|exact re_enough]. destruct axes_ok as [[_ [_ RX]] [_ [_ RY]]]. assert (H := S_some).
  assert (P := u_pos). assert (M := m_range). assert (0 <= 1 + reach ax + reach ay) by lra.
  unfold ray_length. repeat (lra || apply Rmult_le_pos).
Qed.
Lemma slopes : 98 / 100 * slope_of S re ax ay <= place_slope /\ 98 / 100 * slope_of S re ay ax <= place_slope.
Proof.
  destruct axes_ok as [Ax Ay]. destruct counts as [N1 [N2 _]].
  assert (SX := slope_holds ax Ax n n' N1 N2 S re S_some re_pos).
  assert (SY := slope_holds ay Ay n n' N1 N2 S re S_some re_pos).
  simpl start in SX, SY. simpl pixel in SX, SY. fold slope_x in SX. fold slope_y in SY.
  split; [apply Rle_trans with slope_x | apply Rle_trans with slope_y].
  - eapply Rle_trans; [|exact SX]. right. unfold slope_of; simpl. ring.
  - unfold place_slope. eapply Rle_trans; [apply Rmax_r | apply Rmax_l].
  - eapply Rle_trans; [|exact SY]. right. unfold slope_of; simpl. ring.
  - unfold place_slope. apply Rmax_r.
Qed.

Variables (i j : Z) (dx dy : R). (* the pixel, and where in it all rays pass *)
Hypothesis i_pixel : (0 <= i < width)%Z.
Hypothesis j_pixel : (0 <= j < height)%Z.
Hypothesis shift : Rabs dx <= / 2 /\ Rabs dy <= / 2.

Notation in_picture_both :=
  (Window.in_picture_both x0 x1 y0 y1 width height sizes window_ok pixels i j dx dy i_pixel j_pixel shift).
Notation in_picture_x := (proj1 in_picture_both).
Notation in_picture_y := (proj2 in_picture_both).

(** The ray as [camera_rays] stores it. *)
Definition d := fdirection (window_at x0 (film_at (IZR i) dx) (pixel ax)) (window_at y0 (film_at (IZR j) dy) (pixel ay)) right up forward.
Notation see := (seen right up forward x0 y0 (pixel ax) (pixel ay) dx dy o d (IZR i + / 2) (IZR j + / 2) (common right up forward)).
Notation sees := (fun v Z => floats v /\ exists V O, within v V /\ within o O /\ Z = vertex_size V O).

Lemma solid : volume right up forward <> 0.
Proof. eapply vol_not_0; eassumption. Qed.
Lemma near_100 : let off d e := off_by (common right up forward) d e in
  off Dr (dual_right right up forward) <= 100 * (u * S) /\
  off Du (dual_up right up forward) <= 100 * (u * S) /\
  off Df (dual_depth right up forward) <= 100 * (u * S).
Proof.
  assert (P := u_pos). assert (H := S_some). assert (0 < u * S) by (apply Rmult_lt_0_compat; lra).
  assert (G : let off d e := L1 (vsub d (vscale (common right up forward) e)) in
    off Dr (dual_right right up forward) <= 33 * (u * S) /\ off Du (dual_up right up forward) <= 33 * (u * S) /\
    off Df (dual_depth right up forward) <= 33 * (u * S)).
  { eapply dual_near_common; try eassumption; apply m_range. }
  simpl in G. unfold off_by. simpl. lra.
Qed.
Lemma common_near : Rabs (common right up forward - 1) <= / 100 /\ Rabs (common right up forward - 1) <= 54 * (u * (S * m)).
Proof. eapply common_small; try eassumption; apply m_range. Qed.

(** Where a vertex is, as the ray sees it. *)
Theorem vertex_near v Z : sees v Z ->
  near (film_position (fdot Dr (fsub v o)) (fdot Df (fsub v o)) x0 (pixel ax) dx) (vx (see v)) (92 / 100 * (0 + place_slope * Z)) /\
  near (film_position (fdot Du (fsub v o)) (fdot Df (fsub v o)) y0 (pixel ay) dy) (vy (see v)) (92 / 100 * (0 + place_slope * Z)) /\
  near (fdot Df (fsub v o)) (vz (see v)) (92 / 100 * (wt * Z)) /\
  120 * u * (n + n') * Rabs (fdot Df (fsub v o)) <= 0 + place_slope * Z.
Proof.
  intros [Fv [V [O [WV [WO ->]]]]]. destruct (size_holds v o V O WV WO) as [HZ Z0]. set (Z := vertex_size V O) in *.
  assert (Zp : 0 < Z) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact Z0]).
  destruct axes_ok as [Ax Ay]. assert (HS := S_some). assert (P := u_pos). destruct counts as [N1 [N2 _]].
  assert (T := u_tiny). assert (E := eta_u6). assert (Pe := eta_pos).
  assert (RE := re_pos).
  destruct axes_float as [Fr [Fu Ff]].
  assert (G : let x := film_position (fdot Dr (fsub v o)) (fdot Df (fsub v o)) x0 (pixel ax) dx in
    let y := film_position (fdot Du (fsub v o)) (fdot Df (fsub v o)) y0 (pixel ay) dy in
    near x (vx (see v)) (9 / 10 * (slope_of S re ax ay * Z)) /\ near y (vy (see v)) (9 / 10 * (slope_of S re ay ax * Z)) /\
    near (fdot Df (fsub v o)) (vz (see v)) (9 / 10 * (128 * u * S * Z)) /\ Rabs (vz (see v)) <= 101 / 100 * (S * Z)).
  { assert (Sp : L1 Dr <= 1001 / 1000 * S /\ L1 Du <= 1001 / 1000 * S /\ L1 Df <= 1001 / 1000 * S)
      by exact (spread_enough right up forward S S_sum).
    exact (perspective_place right up forward o solid (conj Fr (conj Fu (conj Ff o_float))) m axes_within (proj1 m_range)
      Dr Du Df (common right up forward) S (dual_floats right up forward) near_100 Sp HS (proj1 common_near)
      ax ay Ax Ay re re_enough ray_error_small (IZR i) (IZR j) dx dy in_picture_x in_picture_y v Z Fv HZ Z0). }
  destruct G as [Gx [Gy [Gw Bw]]].
  assert (G0 : forall a b, axis_ok a -> S * (128 * u * (count a + count b)) <= slope_of S re a b).
  { intros a b A. unfold slope_of, Rdiv. apply Rmult_le_compat_l; [lra|].
    assert (K : 0 < / pixel a) by (apply Rinv_0_lt_compat; apply (pixel_pos a A)).
    assert (L0 := Rabs_pos (start a)). destruct A as [_ [_ RX]].
    assert (0 <= u * (1 + Rabs (start a)) * / pixel a) by (repeat (lra || apply Rmult_le_pos)).
    assert (0 <= u * (Rabs (start a) * / pixel a)) by (repeat (lra || apply Rmult_le_pos)).
    assert (0 <= re * (1 + reach a) * / pixel a) by (repeat (lra || apply Rmult_le_pos)). lra. }
  assert (u0 : 0 <= u * (n + n')) by (apply Rmult_le_pos; lra).
  assert (Q0 : forall a b, axis_ok a -> count a + count b = n + n' -> 0 <= slope_of S re a b * Z).
  { intros a b A C. apply Rmult_le_pos; [|lra]. eapply Rle_trans; [|exact (G0 a b A)]. rewrite C.
    apply Rmult_le_pos; lra. }
  assert (Q1 := Q0 ax ay Ax eq_refl). assert (Q2 := Q0 ay ax Ay (Rplus_comm _ _)).
  destruct slopes as [A B].
  assert (AZ : 98 / 100 * slope_of S re ax ay * Z <= place_slope * Z) by (apply Rmult_le_compat_r; lra).
  assert (BZ : 98 / 100 * slope_of S re ay ax * Z <= place_slope * Z) by (apply Rmult_le_compat_r; lra).
  assert (W := weight_holds S HS). fold wt in W.
  assert (uS : u * 1 <= u * S) by (apply Rmult_le_compat_l; lra).
  assert (W1 : 999 / 1000 * (128 * u * S) * Z <= wt * Z) by (apply Rmult_le_compat_r; lra).
  assert (uSZ : 0 < u * S * Z) by (repeat (lra || apply Rmult_lt_0_compat)).
  assert (SZ : 0 < S * Z) by (apply Rmult_lt_0_compat; lra).
  assert (F0 : 98 / 100 * (128 * u * (n + n') * (S * Z)) <= place_slope * Z).
  { eapply Rle_trans; [|exact AZ].
    assert (H := G0 ax ay Ax). simpl count in H.
    assert (H' : 98 / 100 * (S * (128 * u * (n + n'))) * Z <= 98 / 100 * slope_of S re ax ay * Z) by (apply Rmult_le_compat_r; lra).
    lra. }
  split; [|split; [|split]].
  - eapply near_le; [exact Gx | lra].
  - eapply near_le; [exact Gy | lra].
  - eapply near_le; [exact Gw | lra].
  - assert (Ba := near_abs _ _ _ _ Gw Bw).
    assert (Ba' : Rabs (fdot Df (fsub v o)) <= 102 / 100 * (S * Z)).
    { assert (u * (S * Z) <= / 1000000 * (S * Z)) by (apply Rmult_le_compat_r; lra). lra. }
    assert (un : 0 <= u * (n + n')) by (apply Rmult_le_pos; lra).
    assert (C : u * (n + n') * Rabs (fdot Df (fsub v o)) <= u * (n + n') * (102 / 100 * (S * Z))) by (apply Rmult_le_compat_l; lra).
    assert (0 <= u * (n + n') * (S * Z)) by (apply Rmult_le_pos; lra).
    lra.
Qed.

(** The ray itself: before the eye, and the factor of its nearness. *)
Theorem ray_facts : 0 < common right up forward /\ 39 / 40 <= ray_depth right up forward d <= 41 / 40 /\
  Rabs (ray_depth right up forward d * common right up forward - 1) <= 2 * re.
Proof.
  destruct axes_ok as [Ax Ay]. destruct axes_float as [Fr [Fu Ff]]. assert (HS := S_some).
  assert (Sp := spread_enough right up forward S S_sum). destruct common_near as [C1 C2].
  split; [generalize (Rabs_le_inv _ _ C1); lra|]. split.
  - exact (ray_ahead right up forward o solid (conj Fr (conj Fu (conj Ff o_float))) m axes_within (proj1 m_range)
      Dr Du Df (common right up forward) S near_100 Sp HS C1 ax ay Ax Ay re re_enough ray_error_small
      (IZR i) (IZR j) dx dy in_picture_x in_picture_y).
  - apply (nearness_factor right up forward o solid (conj Fr (conj Fu (conj Ff o_float))) m axes_within (proj1 m_range)
      Dr Du Df (common right up forward) S near_100 Sp HS C1 ax ay Ax Ay re re_enough ray_error_small
      (IZR i) (IZR j) dx dy in_picture_x in_picture_y).
    eapply Rle_trans; [exact C2|]. assert (E := re_enough). assert (M := m_range). assert (P := u_pos).
    destruct Ax as [_ [_ RX]], Ay as [_ [_ RY]].
    assert (m <= ray_length m ax ay).
    { unfold ray_length. assert (0 <= m * (reach ax + reach ay)) by (apply Rmult_le_pos; lra). lra. }
    assert (S * m <= S * ray_length m ax ay) by (apply Rmult_le_compat_l; lra).
    assert (u * (S * m) <= u * (S * ray_length m ax ay)) by (apply Rmult_le_compat_l; lra).
    assert (0 <= u * (S * m)) by (repeat (lra || apply Rmult_le_pos)). lra.
Qed.

(** ** Boxes *)
Variables far K : R. (* 2 max (width, height); the float 1.01 *)
Hypothesis far_is : 2 * n <= far /\ 2 * n' <= far /\ far <= 2 * (n + n').
Hypothesis K_value : 10099 / 10000 <= K.
Notation w v := (fdot Df (fsub v o)).
Notation p v := (film_position (fdot Dr (fsub v o)) (w v) x0 (pixel ax) dx).
Notation q v := (film_position (fdot Du (fsub v o)) (w v) y0 (pixel ay) dy).
(** [vertices.ahead]: [w > 2.0**10 * self.weight * size]. *)
Definition is_ahead v Z := rnd (rnd (1024 * wt) * Z) < w v.
Definition low_x v Z := lowest 0 place_slope wt Z far K (p v) (w v) n.
Definition high_x v Z := highest 0 place_slope wt Z far K (p v) (w v) n.
Definition low_y v Z := lowest 0 place_slope wt Z far K (q v) (w v) n'.
Definition high_y v Z := highest 0 place_slope wt Z far K (q v) (w v) n'.

Lemma weight_some : 127 * u * S <= wt.
Proof.
  assert (W := weight_holds S S_some). assert (P := u_pos). assert (E := eta_u6). assert (HS := S_some).
  assert (u * 1 <= u * S) by (apply Rmult_le_compat_l; lra). unfold wt. lra.
Qed.
Lemma ahead_holds v Z : bpow radix2 (-970) <= Z -> is_ahead v Z ->
  0 < w v /\ 1000 * (wt * Z) <= w v /\ eta <= u * w v / 1000.
Proof.
  intros HZ A. unfold is_ahead in A. assert (W := weight_some). assert (P := u_pos). assert (HS := S_some).
  assert (E := eta_u6). assert (Pe := eta_pos).
  assert (Zp : 0 < Z) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact HZ]).
  assert (uS : u * 1 <= u * S) by (apply Rmult_le_compat_l; lra).
  assert (B := lo1 (1024 * wt) ltac:(lra)). assert (B' : 1023 * wt <= rnd (1024 * wt)) by lra.
  assert (C : 1023 * wt * Z <= rnd (1024 * wt) * Z) by (apply Rmult_le_compat_r; lra).
  assert (uZ : 127 * u * Z <= wt * Z) by (apply Rmult_le_compat_r; lra).
  assert (ez : eta <= 2 * (u * (u * Z))).
  { apply Rle_trans with (2 * (u * (u * bpow radix2 (-970)))).
    - right. unfold eta, u. replace (-1074)%Z with (-52 + (-52 + -970))%Z by reflexivity. rewrite !bpow_plus. field.
    - apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; lra. }
  assert (u0 : 0 < u * Z) by (repeat (lra || apply Rmult_lt_0_compat)).
  assert (T := u_tiny). assert (u * (u * Z) <= / 1000000 * (u * Z)) by (apply Rmult_le_compat_r; lra).
  assert (D := lo (rnd (1024 * wt) * Z) (1023 * wt * Z) ltac:(lra) C).
  assert (F : 1000 * (wt * Z) <= w v) by lra. split; [lra|]. split; [exact F|].
  assert (u * (127000 * (u * Z)) <= u * w v) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Section Corner.
Variables (v : vec) (Z : R).
Hypothesis v_sees : sees v Z.
Hypothesis v_ahead : is_ahead v Z.

Lemma corner_ready : 0 < w v /\ eta <= u * w v / 1000 /\ 0 <= Z /\ bpow radix2 (-100) <= wt /\
  0 <= place_slope /\ 50 * u * far * w v <= place 0 place_slope Z.
Proof.
  destruct v_sees as [Fv [V [O [WV [WO EZ]]]]]. destruct (size_holds v o V O WV WO) as [_ Z0]. rewrite <- EZ in Z0.
  destruct (ahead_holds v Z Z0 v_ahead) as [A [_ B]]. assert (Zp : 0 < Z) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact Z0]).
  repeat split; try assumption; try lra.
  - apply Rle_trans with (127 * u * S); [|exact weight_some].
    assert (P := u_pos). assert (HS := S_some). assert (u * 1 <= u * S) by (apply Rmult_le_compat_l; lra).
    apply Rle_trans with (127 * u); [|lra]. unfold u.
    assert (bpow radix2 (-100) <= bpow radix2 (-52)) by (apply bpow_le; lia). generalize (bpow_ge_0 radix2 (-52)). lra.
  - unfold place_slope. eapply Rle_trans; [apply Rmax_l | apply Rmax_l].
  - destruct (vertex_near v Z v_sees) as [_ [_ [_ H]]]. rewrite (Rabs_pos_eq (w v)) in H by lra. unfold place.
    assert (P := u_pos). assert (u * w v * far <= u * w v * (2 * (n + n'))).
    { apply Rmult_le_compat_l; [apply Rmult_le_pos; lra | tauto]. }
    destruct counts as [N1 [N2 _]]. assert (0 <= u * (n + n') * w v) by (repeat (lra || apply Rmult_le_pos)). lra.
Qed.

Lemma corner_x : (vx (see v) - (IZR i + / 2) * vz (see v) <= 0 -> low_x v Z <= IZR i) /\
  (0 <= vx (see v) - (IZR i + / 2) * vz (see v) -> high_x v Z <= - IZR i).
Proof.
  destruct corner_ready as [W0 [W1 [Zp [Ww [Sl Ps]]]]]. destruct (vertex_near v Z v_sees) as [X [Y [W _]]].
  destruct far_is as [F1 [F2 F3]]. split; intros H.
  - refine (at_least 0 place_slope wt Z far K K_value (p v) (w v) _ _ X W W0 W1 width (proj1 sizes) F1 (Rle_refl 0) Sl Zp
      (or_intror Ww) Ps i i_pixel _). lra.
  - refine (at_most 0 place_slope wt Z far K K_value (p v) (w v) _ _ X W W0 W1 width (proj1 sizes) F1 (Rle_refl 0) Sl Zp
      (or_intror Ww) Ps i i_pixel _). lra.
Qed.
Lemma corner_y : (vy (see v) - (IZR j + / 2) * vz (see v) <= 0 -> low_y v Z <= IZR j) /\
  (0 <= vy (see v) - (IZR j + / 2) * vz (see v) -> high_y v Z <= - IZR j).
Proof.
  destruct corner_ready as [W0 [W1 [Zp [Ww [Sl Ps]]]]]. destruct (vertex_near v Z v_sees) as [X [Y [W _]]].
  destruct far_is as [F1 [F2 F3]]. split; intros H.
  - refine (at_least 0 place_slope wt Z far K K_value (q v) (w v) _ _ Y W W0 W1 height (proj2 sizes) F2 (Rle_refl 0) Sl Zp
      (or_intror Ww) Ps j j_pixel _). lra.
  - refine (at_most 0 place_slope wt Z far K K_value (q v) (w v) _ _ Y W W0 W1 height (proj2 sizes) F2 (Rle_refl 0) Sl Zp
      (or_intror Ww) Ps j j_pixel _). lra.
Qed.
End Corner.

(** A triangle whose corners are all ahead is met by the rays of its box's pixels alone. *)
Theorem box_holds a b c Za Zb Zc : sees a Za -> sees b Zb -> sees c Zc ->
  is_ahead a Za -> is_ahead b Zb -> is_ahead c Zc -> meets (Ray o d) (Triangle a b c) ->
  Rmin (low_x a Za) (Rmin (low_x b Zb) (low_x c Zc)) <= IZR i /\
  Rmin (high_x a Za) (Rmin (high_x b Zb) (high_x c Zc)) <= - IZR i /\
  Rmin (low_y a Za) (Rmin (low_y b Zb) (low_y c Zc)) <= IZR j /\
  Rmin (high_y a Za) (Rmin (high_y b Zb) (high_y c Zc)) <= - IZR j.
Proof.
  intros Ha Hb Hc Aa Ab Ac M. destruct axes_ok as [Ax Ay]. destruct ray_facts as [_ [Ra _]].
  assert (Rp : 0 < ray_depth right up forward d) by lra.
  destruct (corners_around right up forward x0 y0 (pixel ax) (pixel ay) dx dy (pixel_pos ax Ax) (pixel_pos ay Ay) o d
    (IZR i + / 2) (IZR j + / 2) (common right up forward) Rp a b c M) as [F [F' [G [G' _]]]].
  destruct (corner_x a Za Ha Aa) as [a1 a2]. destruct (corner_x b Zb Hb Ab) as [b1 b2]. destruct (corner_x c Zc Hc Ac) as [c1 c2].
  destruct (corner_y a Za Ha Aa) as [a3 a4]. destruct (corner_y b Zb Hb Ab) as [b3 b4]. destruct (corner_y c Zc Hc Ac) as [c3 c4].
  apply (box_of_three low_x high_x low_y high_y
    (fun v => vx (see v) - (IZR i + / 2) * vz (see v)) (fun v => vy (see v) - (IZR j + / 2) * vz (see v))).
  - exact (conj F (conj F' (conj G G'))).
  - exact (conj a1 (conj a2 (conj a3 a4))).
  - exact (conj b1 (conj b2 (conj b3 b4))).
  - exact (conj c1 (conj c2 (conj c3 c4))).
Qed.

(** What is seen of it, beyond the clip start, is not nearer than the largest [nearest] of its corners. *)
Theorem nearest_seen a b c Za Zb Zc clip_start (t := Geometry.depth (Ray o d) (Triangle a b c))
  (near_v := fun v Z => nearest (w v) Z wt re clip_start) : sees a Za -> sees b Zb -> sees c Zc ->
  meets (Ray o d) (Triangle a b c) -> bpow radix2 (-1000) <= clip_start <= t -> t <= bpow radix2 1000 ->
  / t <= Rmax (near_v a Za) (Rmax (near_v b Zb) (near_v c Zc)).
Proof.
  intros Ha Hb Hc M C T. destruct axes_ok as [Ax Ay]. destruct ray_facts as [_ [Ra Rf]].
  assert (Rp : 0 < ray_depth right up forward d) by lra.
  destruct (corners_around right up forward x0 y0 (pixel ax) (pixel ay) dx dy (pixel_pos ax Ax) (pixel_pos ay Ay) o d
    (IZR i + / 2) (IZR j + / 2) (common right up forward) Rp a b c M) as [_ [_ [_ [_ B]]]]. fold t in B.
  assert (RE : 0 <= re) by (generalize (Rabs_pos (ray_depth right up forward d * common right up forward - 1)); lra).
  assert (G : forall v Z, sees v Z -> vz (see v) - t * common right up forward * ray_depth right up forward d <= 0 ->
    / t <= near_v v Z).
  { intros v Z Hv Hd. destruct (vertex_near v Z Hv) as [_ [_ [W _]]].
    destruct Hv as [Fv [V [O [WV [WO EZ]]]]]. destruct (size_holds v o V O WV WO) as [_ Z0]. rewrite <- EZ in Z0.
    apply (nearest_holds (w v) (vz (see v)) Z wt re clip_start t (ray_depth right up forward d * common right up forward));
      try assumption; try lra.
    assert (P := u_pos). assert (HS := S_some). assert (Ww := weight_some).
    assert (u * 1 <= u * S) by (apply Rmult_le_compat_l; lra).
    assert (Zp : 0 < Z) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact Z0]).
    assert (A1 : 127 * u * Z <= wt * Z) by (apply Rmult_le_compat_r; lra).
    assert (A2 : u * bpow radix2 (-970) <= u * Z) by (apply Rmult_le_compat_l; lra).
    assert (A3 : bpow radix2 (-1022) = 2 * (u * bpow radix2 (-970))).
    { unfold u. replace (-1022)%Z with (-52 + -970)%Z by reflexivity. rewrite bpow_plus. field. }
    assert (0 < u * Z) by (apply Rmult_lt_0_compat; lra). lra. }
  apply greatest_of_three. destruct B as [B|[B|B]].
  - left. exact (G a Za Ha B).
  - right. left. exact (G b Zb Hb B).
  - right. right. exact (G c Zc Hc B).
Qed.

(** The edge functions, T and the nearness of the stored ray are the determinants of where it sees the
    corners, which is within [place] and [weight] of where they were computed ([vertex_near]). *)
Theorem decided_by_determinants a b c (pixel_ := V (IZR i + / 2) (IZR j + / 2) 1)
  (r := Ray o d) (tri := Triangle a b c) : exists e_factor t_factor n_factor,
  0 < e_factor /\ 0 < t_factor /\ Rabs (n_factor - 1) <= 2 * re /\
  edge r a b = volume right up forward * e_factor * det (see a) (see b) pixel_ /\
  edge r b c = volume right up forward * e_factor * det (see b) (see c) pixel_ /\
  edge r c a = volume right up forward * e_factor * det (see c) (see a) pixel_ /\
  numerator r tri = volume right up forward * t_factor * det (see a) (see b) (see c) /\
  (numerator r tri <> 0 -> denominator r tri <> 0 -> / Geometry.depth r tri = n_factor *
     ((det (see b) (see c) pixel_ + det (see c) (see a) pixel_ + det (see a) (see b) pixel_) / det (see a) (see b) (see c))).
Proof.
  destruct axes_ok as [Ax Ay]. destruct ray_facts as [Sp [Ra Rf]].
  assert (Rp : 0 < ray_depth right up forward d) by lra. assert (Px := pixel_pos ax Ax). assert (Py := pixel_pos ay Ay).
  set (s := common right up forward) in *.
  exists (pixel ax * pixel ay * ray_depth right up forward d / (s * s)), (pixel ax * pixel ay / (s * s * s)),
    (ray_depth right up forward d * s).
  assert (0 < / (s * s)) by (apply Rinv_0_lt_compat; repeat (assumption || apply Rmult_lt_0_compat)).
  assert (0 < / (s * s * s)) by (apply Rinv_0_lt_compat; repeat (assumption || apply Rmult_lt_0_compat)).
  split; [repeat (assumption || apply Rmult_lt_0_compat)|]. split; [repeat (assumption || apply Rmult_lt_0_compat)|]. split; [exact Rf|].
  pose proof (perspective_edge right up forward solid x0 y0 (pixel ax) (pixel ay) dx dy Px Py o d (IZR i + / 2) (IZR j + / 2) s Sp Rp) as E.
  split; [apply E|]. split; [apply E|]. split; [apply E|]. split.
  - exact (perspective_volume right up forward solid x0 y0 (pixel ax) (pixel ay) dx dy Px Py o d (IZR i + / 2) (IZR j + / 2) s Sp a b c).
  - exact (perspective_nearness right up forward solid x0 y0 (pixel ax) (pixel ay) dx dy Px Py o d (IZR i + / 2) (IZR j + / 2) s Sp Rp a b c).
Qed.
End Perspective.
