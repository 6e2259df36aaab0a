(** From the film to the edge functions: the corners that [set_up] begins from are near enough.

    EdgeFunctions.v asks of a triangle's corners, counted from the first pixel of its box, that they are
    within [place] and [weight] of where the pixel's ray sees them (its record [fit]). That is more than
    Perspective.v says of a vertex: p - x0 w is off by what p is, by x0 times what w is, and by two
    roundings. FitSteps.v has the sum.

    Premises that stay: the axes, position, corners are floats; pictures have less than 2^40 pixels
    along an axis; the window is not empty, and its pixels neither tiny nor huge. [reach], a count of
    pixels, is a float of at most 2^32; the box begins in the picture. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Camera Place Film Dual Bounds Boxes FitSteps.
From Reftrace Require EdgeBounds EdgeRoundings EdgeFunctions Window Perspective.
Open Scope R_scope.
Opaque rnd.
Module E := EdgeFunctions.
Module EB := EdgeBounds.
Module ER := EdgeRoundings.
Module P := Perspective.

(** ** A perspective camera *)
Section Perspective.
Variables right up forward o : vec.
Hypothesis axes_float : floats right /\ floats up /\ floats forward.
Hypothesis o_float : floats o.
Hypothesis lengths : dot right right <= 401 / 100 /\ dot up up <= 401 / 100 /\
  dot forward forward <= 401 / 100.
Hypothesis not_flat : 1249 / 10000 <= Rabs (volume right up forward).
Variable m : R.
Hypothesis axes_within : within right m /\ within up m /\ within forward m.
Hypothesis m_range : / 4 <= m <= 201 / 100.
Notation Dr := (dr right up forward).
Notation Du := (du right up forward).
Notation Df := (df right up forward).
Variable S : R.
Hypothesis S_sum : near S (nine right up forward) (nine right up forward / 10000).
Variables x0 x1 y0 y1 : R.
Variables width height : Z.
Notation n := (IZR width).
Notation n' := (IZR height).
Hypothesis sizes : (1 <= width < 2 ^ 40)%Z /\ (1 <= height < 2 ^ 40)%Z.
Hypothesis window_ok : x0 < x1 /\ y0 < y1.
Notation ax := (window x0 x1 n).
Notation ay := (window y0 y1 n').
Hypothesis pixels : bpow radix2 (-1020) <= pixel ax <= bpow radix2 1000 /\
  bpow radix2 (-1020) <= pixel ay <= bpow radix2 1000.
Notation re := (P.re m S x0 x1 y0 y1 width height).
Hypothesis ray_error_small : re <= / 4.
Variables (i j : Z) (dx dy : R).
Hypothesis i_pixel : (0 <= i < width)%Z.
Hypothesis j_pixel : (0 <= j < height)%Z.
Hypothesis shift : Rabs dx <= / 2 /\ Rabs dy <= / 2.

Notation d := (P.d right up forward x0 x1 y0 y1 width height i j dx dy).
Notation see := (seen right up forward x0 y0 (pixel ax) (pixel ay) dx dy o d (IZR i + / 2) (IZR j + / 2)
  (common right up forward)).
Notation sees := (fun v Z => floats v /\ exists V O, within v V /\ within o O /\ Z = vertex_size V O).
Notation w v := (fdot Df (fsub v o)).
Notation p v := (film_position (fdot Dr (fsub v o)) (w v) x0 (pixel ax) dx).
Notation q v := (film_position (fdot Du (fsub v o)) (w v) y0 (pixel ay) dy).
(** What [film.py] stores of a vertex. *)
Definition stored v := V (p v) (q v) (w v).
Notation wt := (P.wt S).
Notation place_slope := (P.place_slope m S x0 x1 y0 y1 width height).

(** The pixel that is counted from. *)
Variables zx zy : R.
Hypothesis zx_in : 0 <= zx <= n.
Hypothesis zy_in : 0 <= zy <= n'.

Lemma slopes : let s a b := 98 / 100 * slope_of S re a b in
  s ax ay <= place_slope /\ s ay ax <= place_slope /\ 250 * (u * S) <= place_slope /\ 0 <= re /\ 1 <= S.
Proof.
  destruct (Window.axes_ok x0 x1 y0 y1 width height sizes pixels) as [Ax Ay].
  destruct (Window.counts width height sizes) as [N1 [N2 _]]. assert (P := u_pos).
  assert (HS : 1 <= S) by (eapply P.S_some; eassumption).
  assert (RE : 0 <= re) by (eapply P.re_pos; eassumption).
  assert (AB : 98 / 100 * slope_of S re ax ay <= place_slope /\ 98 / 100 * slope_of S re ay ax <= place_slope)
    by (eapply P.slopes; eassumption).
  destruct AB as [A B0]. split; [exact A|]. split; [exact B0|]. split; [|split; assumption].
  - eapply Rle_trans; [|exact A].
    assert (K : 0 < / pixel ax) by (apply Rinv_0_lt_compat; apply (pixel_pos ax Ax)).
    unfold slope_of, Rdiv. assert (L0 := Rabs_pos (start ax)). destruct Ax as [_ [_ RX]].
    assert (0 <= u * (1 + Rabs (start ax)) * / pixel ax) by (repeat (lra || apply Rmult_le_pos)).
    assert (0 <= u * (Rabs (start ax) * / pixel ax)) by (repeat (lra || apply Rmult_le_pos)).
    assert (0 <= re * (1 + reach ax) * / pixel ax) by (repeat (lra || apply Rmult_le_pos)).
    assert (un : u * 2 <= u * (n + n')) by (apply Rmult_le_compat_l; lra).
    match goal with |- _ <= _ * (S * ?t) => assert (B : 256 * u <= t) by (simpl in *; lra); revert B;
      generalize t end.
    intros t B. assert (S * (256 * u) <= S * t) by (apply Rmult_le_compat_l; lra).
    assert (0 <= u * S) by (apply Rmult_le_pos; lra). lra.
Qed.

Theorem relative_near v Z (c := EB.relative zx zy (stored v)) (c' := E.moved zx zy (see v)) : sees v Z ->
  near (vx c) (vx c') (92 / 100 * (place_slope * Z)) /\ near (vy c) (vy c') (92 / 100 * (place_slope * Z)) /\
  near (vz c) (vz c') (92 / 100 * (wt * Z)) /\ Rabs (vz c) <= 102 / 100 * (S * Z) /\ bpow radix2 (-960) <= Z.
Proof.
  intros Hv. destruct slopes as [SX [SY [S0 [RE HS]]]]. cbv beta in SX, SY.
  destruct (Window.axes_ok x0 x1 y0 y1 width height sizes pixels) as [Ax Ay].
  assert (Gw : near (w v) (vz (see v)) (92 / 100 * (wt * Z))).
  { assert (G := P.vertex_near right up forward o axes_float o_float lengths not_flat m axes_within m_range
    S S_sum
      x0 x1 y0 y1 width height sizes window_ok pixels ray_error_small i j dx dy i_pixel j_pixel shift v Z
        Hv). tauto. }
  destruct Hv as [Fv [VV [O [WV [WO ->]]]]]. destruct (size_holds v o VV O WV WO) as [HZ Z0].
  assert (Z1 : bpow radix2 (-960) <= vertex_size VV O).
  { apply size_some; (eapply Rle_trans; [apply Rabs_pos|]); [apply WV | apply WO]. }
  set (Z := vertex_size VV O) in *.
  assert (Zp : 0 < Z) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact Z0]). assert (P := u_pos).
  assert (T := u_tiny).
  assert (Hc : Rabs (common right up forward - 1) <= / 100) by (eapply P.common_near; eassumption).
  assert (N100 : off_by (common right up forward) Dr (dual_right right up forward) <= 100 * (u * S) /\
    off_by (common right up forward) Du (dual_up right up forward) <= 100 * (u * S) /\
    off_by (common right up forward) Df (dual_depth right up forward) <= 100 * (u * S)).
  { eapply P.near_100; eassumption. }
  assert (REn : 47 * (u * (S * ray_length m ax ay)) <= re) by (eapply P.re_enough; eassumption).
  assert (Solid : volume right up forward <> 0) by (eapply P.solid; eassumption).
  destruct (Window.in_picture_both x0 x1 y0 y1 width height sizes window_ok pixels i j dx dy i_pixel j_pixel
    shift) as [X Y].
  assert (A : 39 / 40 <= ray_depth right up forward d <= 41 / 40) by (eapply P.ray_facts; eassumption).
  assert (F4 : floats right /\ floats up /\ floats forward /\ floats o) by tauto.
  assert (Sp := spread_enough right up forward S S_sum). assert (FD := dual_floats right up forward).
  assert (M4 := proj1 m_range).
  destruct N100 as [N0 [N1 N2]], Sp as [K0 [K1 K2]], FD as [F0 [F1 F2]].
  destruct (coordinate o o_float (common right up forward) S HS Hc v Z Fv HZ Z0 Dr _ F0 N0 K0) as [Cr Br].
  destruct (coordinate o o_float (common right up forward) S HS Hc v Z Fv HZ Z0 Du _ F1 N1 K1) as [Cu Bu].
  destruct (coordinate o o_float (common right up forward) S HS Hc v Z Fv HZ Z0 Df _ F2 N2 K2) as [Cd Bd].
  destruct (ray_near right up forward o Solid F4 m axes_within M4 Dr Du Df (common right up forward) S
    (conj N0 (conj N1 N2)) (conj K0 (conj K1 K2)) HS Hc ax ay Ax Ay re REn (IZR i) (IZR j) dx dy X Y) as
      [Rx [Ry Rz]].
  unfold ray_depth in A.
  assert (PX := pixel_pos ax Ax). assert (PY := pixel_pos ay Ay).
  assert (uSZ : 0 < u * (S * Z)) by (apply Rmult_lt_0_compat; [lra | apply Rmult_lt_0_compat; lra]).
  assert (0 <= place_slope * Z).
  { apply Rmult_le_pos; [|lra]. assert (0 <= u * S) by (apply Rmult_le_pos; lra). lra. }
  split; [|split; [|split; [|split]]]; try assumption.
  - apply near_le with (9 / 10 * (slope_of S re ax ay * Z)).
    2: { assert (98 / 100 * slope_of S re ax ay * Z <= place_slope * Z) by (apply Rmult_le_compat_r; lra).
         lra. }
    unfold c', E.moved. cbn [vx].
    replace (vx (see v) - zx * vz (see v)) with
      ((common right up forward * dot (dual_right right up forward) (vsub v o) -
         start ax * (common right up forward * dot (dual_depth right up forward) (vsub v o))) / pixel ax -
       dx * (common right up forward * dot (dual_depth right up forward) (vsub v o)) -
       (((vx (coords right up forward d) - start ax * vz (coords right up forward d)) / pixel ax -
          dx * vz (coords right up forward d)) / vz (coords right up forward d) - (IZR i + / 2)) *
       (common right up forward * dot (dual_depth right up forward) (vsub v o)) -
       zx * (common right up forward * dot (dual_depth right up forward) (vsub v o))).
    + apply (relative_along S re ax ay dx _ _ _ _ _ Z zx); try assumption; [exact (proj1 shift)|].
      apply beside_pixel; assumption.
    + unfold seen, shear, film, off_x, ray_depth, film. revert A. generalize (coords right up forward d).
      intros [c0 c1 c2]; simpl in PX, PY |- *; intros. field. repeat split; lra.
  - apply near_le with (9 / 10 * (slope_of S re ay ax * Z)).
    2: { assert (98 / 100 * slope_of S re ay ax * Z <= place_slope * Z) by (apply Rmult_le_compat_r; lra).
    lra. }
    unfold c', E.moved. cbn [vy].
    replace (vy (see v) - zy * vz (see v)) with
      ((common right up forward * dot (dual_up right up forward) (vsub v o) -
         start ay * (common right up forward * dot (dual_depth right up forward) (vsub v o))) / pixel ay -
       dy * (common right up forward * dot (dual_depth right up forward) (vsub v o)) -
       (((vy (coords right up forward d) - start ay * vz (coords right up forward d)) / pixel ay -
          dy * vz (coords right up forward d)) / vz (coords right up forward d) - (IZR j + / 2)) *
       (common right up forward * dot (dual_depth right up forward) (vsub v o)) -
       zy * (common right up forward * dot (dual_depth right up forward) (vsub v o))).
    + apply (relative_along S re ay ax dy _ _ _ _ _ Z zy); try assumption; [exact (proj2 shift)|].
      apply beside_pixel; assumption.
    + unfold seen, shear, film, off_y, ray_depth, film. revert A. generalize (coords right up forward d).
      intros [c0 c1 c2]; simpl in PX, PY |- *; intros. field. repeat split; lra.
  - assert (B := near_abs _ _ _ _ Cd Bd). unfold c. simpl.
    assert (u * (S * Z) <= / 1000000 * (S * Z)) by (apply Rmult_le_compat_r; [|lra]; apply Rmult_le_pos;
      lra). lra.
Qed.

(** [place] and [weight] of [set_up], where [size] is the largest of the corners'. *)
Definition place_of size := rnd (0 + rnd (place_slope * size)).
Definition weight_of size := rnd (wt * size).
Lemma enough Z size : bpow radix2 (-960) <= Z -> Z <= size ->
  92 / 100 * (place_slope * Z) <= place_of size /\ 92 / 100 * (wt * Z) <= weight_of size /\
  240 * (u * (S * size)) <= place_of size /\ 64 * (u * (S * size)) <= weight_of size <= 132 * (u * (S *
    size)).
Proof.
  intros Z0 Zs. destruct slopes as [_ [_ [S0 [RE HS]]]]. assert (P := u_pos). assert (T := u_tiny).
  assert (Zp : 0 < Z) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact Z0]).
  assert (Sz : bpow radix2 (-970) <= size).
  { eapply Rle_trans; [|exact Zs]. eapply Rle_trans; [|exact Z0]. apply bpow_le. lia. }
  assert (E0 := eta_unit S HS size Sz). assert (Pe := eta_pos). assert (E6 := eta_u6).
  set (g := u * (S * size)) in *.
  assert (uS : u * 1 <= u * S) by (apply Rmult_le_compat_l; lra).
  assert (A : 250 * g <= place_slope * size).
  { apply Rle_trans with (250 * (u * S) * size); [unfold g; right; ring | apply Rmult_le_compat_r; lra]. }
  assert (B := weight_holds S HS). fold wt in B.
  assert (C := hi (64 * eps * S) (128 * (u * S)) ltac:(lra) ltac:(rewrite eps_u; lra)).
  fold (weight S) wt in C.
  assert (B' : 127 * g <= wt * size).
  { apply Rle_trans with (127 * (u * S) * size); [unfold g; right; ring | apply Rmult_le_compat_r; lra]. }
  assert (C' : wt * size <= 130 * g).
  { apply Rle_trans with (130 * (u * S) * size); [apply Rmult_le_compat_r; lra | unfold g; right; ring]. }
  assert (ps : place_slope * Z <= place_slope * size) by (apply Rmult_le_compat_l; lra).
  assert (ws : wt * Z <= wt * size) by (apply Rmult_le_compat_l; lra).
  assert (g0 : 0 < g) by (unfold g; repeat (lra || apply Rmult_lt_0_compat)).
  assert (F := lo1 (place_slope * size) ltac:(lra)).
  assert (G := lo1 (0 + rnd (place_slope * size)) ltac:(lra)). fold (place_of size) in G.
  assert (F' := lo1 (wt * size) ltac:(lra)). assert (G' := hi (wt * size) (130 * g) ltac:(lra) C').
  fold (weight_of size) in F', G'. lra.
Qed.

(** The premise of EdgeFunctions.v, for a perspective camera's stored triangle, at any pixel. *)
Theorem perspective_fit a b c Za Zb Zc from_here (size := Rmax (Rmax Za Zb) Zc)
  (stored_ := fun v => EB.relative zx zy (stored v)) (exact_ := fun v => E.moved zx zy (see v)) :
  sees a Za -> sees b Zb -> sees c Zc -> is_float from_here -> 1 <= from_here <= 4294967296 ->
  E.fit (place_of size) (weight_of size) from_here (stored_ a) (stored_ b) (stored_ c)
    (exact_ a) (exact_ b) (exact_ c).
Proof.
  intros Ha Hb Hc Ff Hf. destruct slopes as [_ [_ [S0 [RE HS]]]]. assert (P := u_pos). assert (T := u_tiny).
  assert (La : Za <= size) by (unfold size; eapply Rle_trans; [apply Rmax_l | apply Rmax_l]).
  assert (Lb : Zb <= size) by (unfold size; eapply Rle_trans; [apply Rmax_r | apply Rmax_l]).
  assert (Lc : Zc <= size) by (unfold size; apply Rmax_r).
  assert (G : forall v Z, sees v Z -> Z <= size ->
    ER.close (place_of size) (weight_of size) (stored_ v) (exact_ v) /\
    Rabs (vz (stored_ v)) <= 102 / 100 * (S * size) /\ bpow radix2 (-960) <= Z).
  { intros v Z Hv Lv. destruct (relative_near v Z Hv) as [X [Y [W [B Z0]]]].
    destruct (enough Z size Z0 Lv) as [E1 [E2 _]].
    assert (S * Z <= S * size) by (apply Rmult_le_compat_l; lra).
    split; [|split; [unfold stored_; lra | exact Z0]].
    split; [|split]; (eapply Rle_trans; [eassumption | assumption]). }
  destruct (G a Za Ha La) as [Ca [Ba Z0]]. destruct (G b Zb Hb Lb) as [Cb [Bb _]].
  destruct (G c Zc Hc Lc) as [Cc [Bc _]].
  destruct (enough Za size Z0 La) as [_ [_ [E1 [E2 E3]]]].
  assert (Zp : bpow radix2 (-960) <= size) by lra. assert (B0 := bpow_gt_0 radix2 (-960)).
  assert (Sz : 1 * size <= S * size) by (apply Rmult_le_compat_r; lra).
  assert (usz : u * (1 * size) <= u * (S * size)) by (apply Rmult_le_compat_l; lra).
  assert (g0 : 0 < u * (S * size)) by (repeat (lra || apply Rmult_lt_0_compat)).
  assert (Ft : forall v, ER.float_vec (stored_ v)) by (intros v; repeat split; apply rnd_float).
  assert (Tp : 0 <= EB.top (stored_ a) (stored_ b) (stored_ c) <= 102 / 100 * (S * size)).
  { unfold EB.top. split; [eapply Rle_trans; [apply Rabs_pos | apply Rmax_r]|].
  repeat apply Rmax_lub; assumption. }
  constructor; try assumption; try apply rnd_float; try apply Ft; try lra.
  - apply Rle_trans with (64 * (u * bpow radix2 (-960))).
    + assert (V : 64 * u = bpow radix2 (-47)) by (rewrite u_value; simpl; lra).
      rewrite <- Rmult_assoc, V, <- bpow_plus. apply bpow_le. lia.
    + assert (u * bpow radix2 (-960) <= u * size) by (apply Rmult_le_compat_l; lra). lra.
  - assert (V : bpow radix2 60 * u = 128) by (rewrite u_value; simpl; lra).
    assert (bpow radix2 60 * (240 * (u * (S * size))) <= bpow radix2 60 * place_of size).
    { apply Rmult_le_compat_l; [apply bpow_ge_0 | exact E1]. }
    replace (bpow radix2 60 * (240 * (u * (S * size)))) with (240 * (bpow radix2 60 * u) * (S * size)) in *
      by ring.
    rewrite V in *. assert (u * (S * size) <= / 1000000 * (S * size)) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(** ** What is decided of the pixel (i, j), of a ray and a triangle as they are stored *)
Section Decided.
Variables (a b c : vec) (Za Zb Zc from_here up_ right_ : R).
Hypothesis sees_a : sees a Za. Hypothesis sees_b : sees b Zb. Hypothesis sees_c : sees c Zc.
(** The pixel is [right_] to the right of the one that is counted from, and [up_] above. *)
Hypothesis pixel_x : zx + right_ = IZR i + / 2.
Hypothesis pixel_y : zy + up_ = IZR j + / 2.
Hypothesis up_float : is_float up_. Hypothesis right_float : is_float right_.
Hypothesis from_float : is_float from_here. Hypothesis from_size : 1 <= from_here <= 4294967296.
Hypothesis up_in : Rabs up_ <= from_here. Hypothesis right_in : Rabs right_ <= from_here.
Let size := Rmax (Rmax Za Zb) Zc.
Let A := EB.relative zx zy (stored a).
Let B := EB.relative zx zy (stored b).
Let C := EB.relative zx zy (stored c).
Let far := EB.far_of (EB.span A B C) (place_of size).
Let high := EB.high_of (EB.top A B C) (weight_of size).
Let T_ := EB.volume A B C.
Let t_max := EB.volume_error (place_of size) (weight_of size) far high.
Let e_max := EB.edge_error from_here (place_of size) (weight_of size) far high.
Let r := Ray o d.
Let tri := Triangle a b c.
Let at_edge s u v := EB.signed_edge s u v up_ right_.
Let least s := Rmin (Rmin (at_edge s B C) (at_edge s C A)) (at_edge s A B).

Lemma fits : E.fit (place_of size) (weight_of size) from_here A B C
  (E.moved zx zy (see a)) (E.moved zx zy (see b)) (E.moved zx zy (see c)).
Proof. apply perspective_fit; assumption. Qed.
Lemma at_pixel u v : det (E.moved zx zy u) (E.moved zx zy v) (ER.pixel_ray up_ right_) =
  det u v (V (IZR i + / 2) (IZR j + / 2) 1).
Proof.
  rewrite <- (E.moved_det zx zy u v (IZR i + / 2) (IZR j + / 2)).
  replace up_ with (IZR j + / 2 - zy) by lra. replace right_ with (IZR i + / 2 - zx) by lra. reflexivity.
Qed.
Lemma determinants : exists e_factor t_factor,
  e_factor <> 0 /\ 0 < t_factor /\
  (let e u v := e_factor * det (see u) (see v) (V (IZR i + / 2) (IZR j + / 2) 1) in
   edge r a b = e a b /\ edge r b c = e b c /\ edge r c a = e c a) /\
  numerator r tri = e_factor * t_factor * det (see a) (see b) (see c).
Proof.
  assert (V0 : volume right up forward <> 0) by (eapply P.solid; eassumption).
  destruct (P.decided_by_determinants right up forward o axes_float o_float lengths not_flat m axes_within
    m_range
    S S_sum x0 x1 y0 y1 width height sizes window_ok pixels ray_error_small i j dx dy i_pixel j_pixel shift
      a b c)
    as [ef [tf [_ [E0 [T0 [_ [E1 [E2 [E3 [E4 _]]]]]]]]]].
  exists (volume right up forward * ef), (tf / ef). split; [|split; [|split]].
  - apply Rmult_integral_contrapositive. split; [exact V0 | lra].
  - apply Rmult_lt_0_compat; [exact T0 | now apply Rinv_0_lt_compat].
  - split; [exact E1 | split; [exact E2 | exact E3]].
  - unfold r, tri. rewrite E4. field. lra.
Qed.

(** What is sure to be inside: the ray meets the triangle, at no edge, and before the eye. *)
Theorem surely_inside (s := EB.sign_of T_) : Rabs T_ > t_max ->
  at_edge s B C > e_max -> at_edge s C A > e_max -> at_edge s A B > e_max ->
  meets_inside r tri /\ 0 < Geometry.depth r tri.
Proof.
  intros H1 H2 H3 H4.
  destruct (E.sure_inside _ _ _ _ _ _ _ _ _ fits up_ right_ up_float right_float up_in right_in H1 H2 H3 H4)
    as [T0 [e_bc [e_ca [e_ab D]]]].
  rewrite E.moved_volume, !at_pixel in *.
  destruct determinants as [ef [tf [E0 [Tf [[E1 [E2 E3]] N]]]]].
  split.
  - unfold meets_inside, tri. cbn [ca cb cc]. rewrite E1, E2, E3. eapply all_inside; eassumption.
  - unfold Geometry.depth. rewrite N, denominator_sum. unfold tri. cbn [ca cb cc]. rewrite E1, E2, E3.
    set (T := det (see a) (see b) (see c)) in *. rewrite <- !Rmult_plus_distr_l.
    set (x := det (see a) (see b) _ + _ + _).
    assert (X : T * x > 0) by (unfold x; lra).
    assert (x <> 0) by (intros Z; rewrite Z in X; lra).
    replace (ef * tf * T / (ef * x)) with (tf * (T * x) * / (x * x)) by (field; split; assumption).
    apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat; lra | apply Rinv_0_lt_compat, square_pos; assumption].
Qed.

(** What is dropped, where T is sure: the ray does not meet the triangle before the eye. *)
Theorem dropped (s := EB.sign_of T_) : Rabs T_ > t_max -> least s < - e_max ->
  ~ (meets r tri /\ 0 < Geometry.depth r tri).
Proof.
  intros H1 H2 [[D M] Before].
  apply (E.nothing_lost _ _ _ _ _ _ _ _ _ fits up_ right_ up_float right_float up_in right_in H1 H2).
  rewrite E.moved_volume, !at_pixel.
  destruct determinants as [ef [tf [E0 [Tf [[E1 [E2 E3]] N]]]]].
  unfold Geometry.depth in Before. rewrite N in Before. set (T := det (see a) (see b) (see c)) in *.
  assert (DD : denominator r tri = edge r a b + edge r b c + edge r c a) by apply denominator_sum.
  unfold tri in M. cbn [ca cb cc] in M. fold tri in M. set (Den := denominator r tri) in *.
  assert (Q := quotient_pos _ _ D Before).
  assert (Q' : 0 < ef * T * Den) by (apply (pos_left _ tf); [lra | exact Tf]).
  rewrite E1, E2, E3 in M, DD. destruct M as [[M1 [M2 M3]]|[M1 [M2 M3]]].
  - assert (Dp : 0 < Den) by lra. assert (0 < ef * T) by exact (pos_left _ _ Q' Dp).
    repeat split; eapply same_sign; eassumption.
  - assert (Dn : Den < 0) by lra. assert (ef * T < 0) by exact (neg_left _ _ Q' Dn).
    repeat split; eapply same_sign'; eassumption.
Qed.

(** What both set-ups drop, where T is not sure: the line of the ray does not meet it anywhere. *)
Theorem dropped_by_both : least 1 < - e_max -> least (-1) < - e_max -> ~ meets r tri.
Proof.
  intros H1 H2 [_ M].
  destruct (E.nothing_lost_unsure _ _ _ _ _ _ _ _ _ fits up_ right_ up_float right_float up_in right_in H1 H2)
    as [L1 L2]. rewrite !at_pixel in L1, L2.
  destruct determinants as [ef [tf [E0 [Tf [[E1 [E2 E3]] N]]]]].
  unfold tri in M. cbn [ca cb cc] in M. rewrite E1, E2, E3 in M.
  destruct M as [[M1 [M2 M3]]|[M1 [M2 M3]]]; apply (keeps_sign ef) in M1, M2, M3; try exact E0; lra.
Qed.
End Decided.
End Perspective.
