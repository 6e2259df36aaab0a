(** From the film to the edge functions: an orthographic camera. As Fit.v; here w is 1, for all.

    Premises that stay, besides those of Fit.v: the axes are further from a plane than Perspective.v
    needs ([well_apart]; [well_apart_holds] has it from their lengths and determinant), and window or
    position are not microscopic ([some_length]). *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Camera Place Film Dual Bounds Boxes FitSteps.
From Reftrace Require EdgeBounds EdgeRoundings EdgeFunctions Window Orthographic.
Open Scope R_scope.
Opaque rnd.
Module E := EdgeFunctions.
Module EB := EdgeBounds.
Module ER := EdgeRoundings.
Module O := Orthographic.

Lemma abs_hi x B : Rabs x <= B -> Rabs (rnd x) <= 10001 / 10000 * B + eta.
Proof.
  intros H. assert (R := Rabs_le_inv _ _ (rnd_err x)). assert (G := Rabs_le_inv _ _ H).
  assert (P := u_pos). assert (T := u_tiny). assert (B0 := Rabs_pos x).
  assert (u * Rabs x <= / 10000 * B) by (apply Rmult_le_compat; lra). apply Rabs_le. lra.
Qed.

(** How far from the film's origin a vertex may be: p is a sum of these, and rounded as they are. *)
Lemma position_size a c e B : axis_ok a -> Rabs c <= B -> Rabs e <= / 2 ->
  Rabs (film_position c 1 (start a) (pixel a) e) <= 101 / 100 * ((B + Rabs (start a)) * / pixel a) + 6 / 10.
Proof.
  intros Ok Hc He. assert (K := k_pos a Ok). assert (Ek := eta_k a Ok).
  assert (Ep := eta_pixel _ (proj1 (proj1 Ok))).
  assert (PP := pixel_pos a Ok). assert (P := u_pos). assert (T := u_tiny). assert (Pe := eta_pos).
  assert (E6 := eta_u6).
  set (k := / pixel a) in *. set (l := Rabs (start a)) in *. assert (L0 : 0 <= l) by apply Rabs_pos.
  assert (B0 : 0 <= B) by (eapply Rle_trans; [apply Rabs_pos | exact Hc]).
  assert (ek : eta * k <= u).
  { apply Rle_trans with (u * pixel a / 4 * k); [apply Rmult_le_compat_r; lra|].
    replace (u * pixel a / 4 * k) with (u / 4) by (unfold k; field; lra). lra. }
  assert (S1 : Rabs (rnd (start a * 1)) <= 10001 / 10000 * l + eta) by (apply abs_hi; rewrite Rmult_1_r;
    apply Rle_refl).
  assert (S2 := abs_hi _ _ (tri _ _ _ _ Hc S1)).
  assert (S3 : Rabs (rnd (1 / pixel a)) <= 10002 / 10000 * k).
  { eapply Rle_trans; [apply (abs_hi _ k)|].
    - unfold Rdiv. rewrite Rmult_1_l. fold k. rewrite Rabs_pos_eq; lra.
    - assert (u * k <= / 1000000 * k) by (apply Rmult_le_compat_r; lra). lra. }
  assert (S4 := abs_hi _ _ (prod _ _ _ _ S2 S3)).
  assert (S5 : Rabs (rnd (e * 1)) <= 10001 / 10000 * / 2 + eta) by (apply abs_hi; rewrite Rmult_1_r;
    exact He).
  assert (S6 := abs_hi _ _ (tri _ _ _ _ S4 S5)). unfold film_position. eapply Rle_trans; [exact S6|].
  assert (0 <= B * k) by (apply Rmult_le_pos; lra). assert (0 <= l * k) by (apply Rmult_le_pos; lra).
  lra.
Qed.

Lemma squares_of x : x * x = Rabs x * Rabs x.
Proof. rewrite <- Rabs_mult, Rabs_pos_eq; [reflexivity | apply Rle_0_sqr]. Qed.
Lemma cauchy a b c x y z : (a * x + b * y + c * z) * (a * x + b * y + c * z) <=
  (a * a + b * b + c * c) * (x * x + y * y + z * z).
Proof.
  generalize (Rle_0_sqr (a * y - b * x)) (Rle_0_sqr (a * z - c * x)) (Rle_0_sqr (b * z - c * y)).
  unfold Rsqr. lra.
Qed.
Lemma permanent_pairs p q r x y z :
  (q * z + r * y) * (q * z + r * y) + (r * x + p * z) * (r * x + p * z) + (p * y + q * x) * (p * y + q * x) <=
  2 * ((p * p + q * q + r * r) * (x * x + y * y + z * z)).
Proof.
  generalize (Rle_0_sqr (q * z - r * y)) (Rle_0_sqr (r * x - p * z)) (Rle_0_sqr (p * y - q * x))
    (Rle_0_sqr (p * x)) (Rle_0_sqr (q * y)) (Rle_0_sqr (r * z)).
  unfold Rsqr. lra.
Qed.

(** [well_apart] of Orthographic.v, as [has_sound_axes] asks for it: the determinant is not less than an
    eighth of the product of the axes' lengths (but for its own roundings). By Cauchy and Schwarz the
    permanent is at most the square root of 2 times that product. *)
Theorem well_apart_holds right up forward :
  dot right right * (dot up up * dot forward forward) <=
    801 / 100 * Rabs (volume right up forward) * (801 / 100 * Rabs (volume right up forward)) ->
  permanent right up forward <= 119 / 10 * Rabs (volume right up forward).
Proof.
  generalize (Rabs_pos (volume right up forward)). generalize (Rabs (volume right up forward)).
  intros v V H. unfold permanent, dot in *.
  destruct right as [a b c], up as [p q r], forward as [x y z]. simpl in *.
  rewrite (squares_of a), (squares_of b), (squares_of c), (squares_of p), (squares_of q), (squares_of r),
    (squares_of x), (squares_of y), (squares_of z) in H.
  revert H. generalize (Rabs a) (Rabs b) (Rabs c) (Rabs p) (Rabs q) (Rabs r) (Rabs x) (Rabs y) (Rabs z).
  clear a b c p q r x y z. intros a b c p q r x y z H.
  assert (G := cauchy a b c (q * z + r * y) (r * x + p * z) (p * y + q * x)).
  assert (K := permanent_pairs p q r x y z).
  set (s := (q * z + r * y) * (q * z + r * y) + (r * x + p * z) * (r * x + p * z) + (p * y + q * x) * (p *
    y + q * x)) in *.
  set (e := a * (q * z + r * y) + b * (r * x + p * z) + c * (p * y + q * x)) in *.
  assert (S : forall x, 0 <= x * x) by (intros; apply Rle_0_sqr).
  assert (L : (a * a + b * b + c * c) * s <=
    (a * a + b * b + c * c) * (2 * ((p * p + q * q + r * r) * (x * x + y * y + z * z)))).
  { apply Rmult_le_compat_l; [generalize (S a) (S b) (S c); lra | lra]. }
  destruct (Rle_or_lt e (119 / 10 * v)) as [|N]; [assumption | exfalso].
  assert (119 / 10 * v * (119 / 10 * v) <= e * e) by (apply Rmult_le_compat; lra).
  assert (P : e * e <= 2 * (801 / 100 * v * (801 / 100 * v))) by lra.
  assert (Q : 0 <= v * v) by apply S. assert (Z : v * v <= 0) by lra.
  assert (0 < e) by lra. assert (0 < e * e) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(** ** An orthographic camera *)
Section Parallel.
Variables right up forward o : vec.
Hypothesis axes_float : floats right /\ floats up /\ floats forward.
Hypothesis o_float : floats o.
Hypothesis lengths : dot right right <= 401 / 100 /\ dot up up <= 401 / 100 /\
  dot forward forward <= 401 / 100.
Hypothesis not_flat : 1249 / 10000 <= Rabs (volume right up forward).
Hypothesis well_apart : permanent right up forward <= 119 / 10 * Rabs (volume right up forward).
Variables m most : R.
Hypothesis axes_within : within right m /\ within up m /\ within forward m.
Hypothesis m_range : / 4 <= m <= 201 / 100.
Hypothesis o_within : within o most.
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
Hypothesis some_length : bpow radix2 (-900) <= ray_length' m ax ay most.
Notation re := (O.re' m most S x0 x1 y0 y1 width height).
Notation place_constant := (O.place_constant m most S x0 x1 y0 y1 width height).
Notation place_slope := (O.place_slope' S x0 x1 y0 y1 width height).
Variables (i j : Z) (dx dy : R).
Hypothesis i_pixel : (0 <= i < width)%Z.
Hypothesis j_pixel : (0 <= j < height)%Z.
Hypothesis shift : Rabs dx <= / 2 /\ Rabs dy <= / 2.
Notation oh := (O.oh right up o x0 x1 y0 y1 width height i j dx dy).
Notation see := (seen' right up forward x0 y0 (pixel ax) (pixel ay) dx dy o oh (IZR i + / 2) (IZR j + / 2)).
Notation sees := (fun v Z => floats v /\ exists V, within v V /\ Z = vertex_size V most).
Notation p v := (film_position (fdot Dr (fsub v o)) 1 x0 (pixel ax) dx).
Notation q v := (film_position (fdot Du (fsub v o)) 1 y0 (pixel ay) dy).
Definition stored' v := V (p v) (q v) 1.

(** The pixel that is counted from: its centre, a float. *)
Variables zx zy : R.
Hypothesis zx_in : 0 <= zx <= n.
Hypothesis zy_in : 0 <= zy <= n'.
Hypothesis zx_float : is_float zx.
Hypothesis zy_float : is_float zy.

Lemma bounds : let s a b := constant_of' re a b in let t a := slope_of' S a in
  98 / 100 * s ax ay <= place_constant /\ 98 / 100 * t ax <= place_slope /\
  98 / 100 * s ay ax <= place_constant /\ 98 / 100 * t ay <= place_slope /\
  250 * u <= place_constant /\ 0 <= place_slope /\ 0 <= re /\ 1 <= S.
Proof.
  intros s t. unfold s, t.
  destruct (Window.axes_ok x0 x1 y0 y1 width height sizes pixels) as [Ax Ay].
  destruct (Window.counts width height sizes) as [N1 [N2 _]]. assert (P := u_pos).
  assert (HS : 1 <= S) by (eapply O.S_some; eassumption).
  assert (RE : 0 <= re) by (eapply O.re_pos; eassumption).
  assert (All : 98 / 100 * constant_of' re ax ay <= place_constant /\ 98 / 100 * slope_of' S ax <= place_slope /\
    98 / 100 * constant_of' re ay ax <= place_constant /\ 98 / 100 * slope_of' S ay <= place_slope /\
    0 <= place_constant /\ 0 <= place_slope) by (eapply O.place_bounds; eassumption).
  destruct All as [A1 [A2 [A3 [A4 [_ A5]]]]].
  repeat (split; [assumption|]). split; [|repeat (split; [assumption|]); assumption].
  eapply Rle_trans; [|exact A1]. unfold constant_of', Rdiv.
  assert (K : 0 < / pixel ax) by apply (k_pos ax Ax).
  assert (0 <= Rabs (start ax) * / pixel ax) by (apply Rmult_le_pos; [apply Rabs_pos | lra]).
  assert (0 <= re * / pixel ax) by (apply Rmult_le_pos; lra).
  assert (u * 2 <= u * (n + n')) by (apply Rmult_le_compat_l; lra).
  assert (0 <= u * (Rabs (start ax) * / pixel ax)) by (apply Rmult_le_pos; lra). simpl in *. lra.
Qed.

(** One rounding on top of what [vertex_near'] says: p is not much larger than [place] / 100 u. *)
Lemma relative_one a other c c' e z B Z pc ps : axis_ok a -> axis_ok other -> Rabs c <= B ->
  B <= 102 / 100 * (S * Z) ->
  Rabs e <= / 2 -> is_float z -> 0 <= z <= count a -> 0 <= Z -> 0 <= re ->
  98 / 100 * constant_of' re a other <= pc -> 98 / 100 * slope_of' S a <= ps -> 1 <= S ->
  near (film_position c 1 (start a) (pixel a) e) c' (92 / 100 * (pc + ps * Z)) ->
  near (rnd (film_position c 1 (start a) (pixel a) e - rnd (z * 1))) (c' - z * 1) (95 / 100 * (pc + ps * Z)).
Proof.
  intros Ax Ao Hc HB He Fz Hz HZ RE Hpc Hps HS N. rewrite !Rmult_1_r, (rnd_id z Fz).
  assert (K := k_pos a Ax). assert (G := position_size a c e B Ax Hc He).
  set (p := film_position c 1 (start a) (pixel a) e) in *. assert (R := rnd_err (p - z)).
  assert (P := u_pos). assert (E6 := eta_u6). assert (Pe := eta_pos).
  assert (Na : 1 <= count a) by apply Ax. assert (No : 1 <= count other) by apply Ao.
  set (l := Rabs (start a)) in *. assert (L0 : 0 <= l) by apply Rabs_pos.
  assert (B1 : Rabs (p - z) <= 101 / 100 * ((B + l) * / pixel a) + 6 / 10 + count a).
  { apply tri; [exact G | rewrite Rabs_pos_eq; lra]. }
  assert (B2 : (B + l) * / pixel a <= (102 / 100 * (S * Z) + l) * / pixel a) by (apply Rmult_le_compat_r;
    lra).
  assert (D : u * Rabs (p - z) <= u * (101 / 100 * ((102 / 100 * (S * Z) + l) * / pixel a) + 6 / 10 + count
    a)).
  { apply Rmult_le_compat_l; lra. }
  assert (Q : 98 / 100 * slope_of' S a * Z <= ps * Z) by (apply Rmult_le_compat_r; lra).
  unfold constant_of', slope_of', Rdiv in Hpc, Q. fold l in Hpc.
  assert (0 <= u * (l * / pixel a)) by (repeat (lra || apply Rmult_le_pos)).
  assert (0 <= re * / pixel a) by (repeat (lra || apply Rmult_le_pos)).
  assert (0 <= u * (S * Z * / pixel a)) by (repeat (lra || apply Rmult_le_pos)).
  assert (u * 1 <= u * count a) by (apply Rmult_le_compat_l; lra).
  assert (u * 1 <= u * count other) by (apply Rmult_le_compat_l; lra).
  unfold near in *. replace (rnd (p - z) - (c' - z)) with ((rnd (p - z) - (p - z)) + (p - c')) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.

Theorem relative_near' v Z (c := EB.relative zx zy (stored' v)) (c' := E.moved zx zy (see v)) : sees v Z ->
  near (vx c) (vx c') (95 / 100 * (place_constant + place_slope * Z)) /\
  near (vy c) (vy c') (95 / 100 * (place_constant + place_slope * Z)) /\ bpow radix2 (-960) <= Z.
Proof.
  intros [Fv [VV [WV ->]]]. destruct bounds as [CX [SX [CY [SY [C0 [S0 [RE HS]]]]]]].
  destruct (Window.axes_ok x0 x1 y0 y1 width height sizes pixels) as [Ax Ay].
  destruct (O.vertex_near' right up forward o axes_float o_float lengths not_flat well_apart m most
    axes_within
    m_range o_within S S_sum x0 x1 y0 y1 width height sizes window_ok pixels some_length i j dx dy i_pixel
    j_pixel shift v VV most Fv WV o_within) as [Gx [Gy _]].
  destruct (size_holds v o VV most WV o_within) as [HZ Z0].
  assert (Z1 : bpow radix2 (-960) <= vertex_size VV most).
  { apply size_some; (eapply Rle_trans; [apply Rabs_pos|]); [apply WV | apply o_within]. }
  assert (Zp : 0 < vertex_size VV most) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact Z0]).
  destruct (Window.exactly_near right up forward m S axes_float lengths not_flat well_apart axes_within m_range
    S_sum) as [N0 [N1 [_ One]]].
  set (Z := vertex_size VV most) in *. assert (P := u_pos). assert (T := u_tiny).
  assert (Sp := spread_enough right up forward S S_sum). assert (FD := dual_floats right up forward).
  destruct Sp as [K0 [K1 _]], FD as [F0 [F1 _]].
  destruct (coordinate o o_float 1 S HS One v Z Fv HZ Z0 Dr _ F0 N0 K0) as [Cr Br].
  destruct (coordinate o o_float 1 S HS One v Z Fv HZ Z0 Du _ F1 N1 K1) as [Cu Bu].
  assert (SZ : 0 < S * Z) by (apply Rmult_lt_0_compat; lra).
  assert (small : u * (S * Z) <= / 1000000 * (S * Z)) by (apply Rmult_le_compat_r; lra).
  split; [|split; [|exact Z1]].
  - apply (relative_one ax ay _ _ dx _ _ Z _ _ Ax Ay (near_abs _ _ _ _ Cr Br)); try assumption;
      first [exact (proj1 shift) | lra].
  - apply (relative_one ay ax _ _ dy _ _ Z _ _ Ay Ax (near_abs _ _ _ _ Cu Bu)); try assumption;
      first [exact (proj2 shift) | lra].
Qed.

(** [place] of [set_up]; its [weight] is 0 times the size, 0. *)
Definition place_of' size := rnd (place_constant + rnd (place_slope * size)).
Lemma enough' Z size : bpow radix2 (-960) <= Z -> Z <= size ->
  95 / 100 * (place_constant + place_slope * Z) <= place_of' size /\ 240 * u <= place_of' size.
Proof.
  intros Z0 Zs. destruct bounds as [_ [_ [_ [_ [C0 [S0 _]]]]]]. assert (P := u_pos). assert (T := u_tiny).
  assert (Zp : 0 < Z) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact Z0]). assert (E6 := eta_u6).
  assert (ps : place_slope * Z <= place_slope * size) by (apply Rmult_le_compat_l; lra).
  assert (p0 : 0 <= place_slope * Z) by (apply Rmult_le_pos; lra).
  assert (F := lo1 (place_slope * size) ltac:(lra)). assert (F0 := rnd_pos (place_slope * size) ltac:(lra)).
  assert (G := lo1 (place_constant + rnd (place_slope * size)) ltac:(lra)). fold (place_of' size) in G. lra.
Qed.

(** The premise of EdgeFunctions.v, for an orthographic camera's stored triangle, at any pixel. *)
Theorem parallel_fit a b c Za Zb Zc from_here (size := Rmax (Rmax Za Zb) Zc)
  (stored_ := fun v => EB.relative zx zy (stored' v)) (exact_ := fun v => E.moved zx zy (see v)) :
  sees a Za -> sees b Zb -> sees c Zc -> is_float from_here -> 1 <= from_here <= 4294967296 ->
  E.fit (place_of' size) (rnd (0 * size)) from_here (stored_ a) (stored_ b) (stored_ c)
    (exact_ a) (exact_ b) (exact_ c).
Proof.
  intros Ha Hb Hc Ff Hf. rewrite Rmult_0_l, rnd_0. assert (P := u_pos).
  assert (La : Za <= size) by (unfold size; eapply Rle_trans; [apply Rmax_l | apply Rmax_l]).
  assert (Lb : Zb <= size) by (unfold size; eapply Rle_trans; [apply Rmax_r | apply Rmax_l]).
  assert (Lc : Zc <= size) by (unfold size; apply Rmax_r).
  assert (G : forall v Z, sees v Z -> Z <= size -> ER.close (place_of' size) 0 (stored_ v) (exact_ v) /\
    bpow radix2 (-960) <= Z).
  { intros v Z Hv Lv. destruct (relative_near' v Z Hv) as [X [Y Z0]].
  destruct (enough' Z size Z0 Lv) as [E1 _].
    split; [|exact Z0]. split; [|split].
    - eapply Rle_trans; eassumption.
    - eapply Rle_trans; eassumption.
    - unfold stored_, exact_; simpl. replace (1 - 1) with 0 by ring. rewrite Rabs_R0. apply Rle_refl. }
  destruct (G a Za Ha La) as [Ca Z0]. destruct (G b Zb Hb Lb) as [Cb _]. destruct (G c Zc Hc Lc) as [Cc _].
  destruct (enough' Za size Z0 La) as [_ E1].
  assert (F1 : is_float 1) by (apply (int_float 1); lia).
  assert (Ft : forall v, ER.float_vec (stored_ v)).
  { intros v. split; [apply rnd_float | split; [apply rnd_float | exact F1]]. }
  assert (Tp : EB.top (stored_ a) (stored_ b) (stored_ c) = 1).
  { unfold EB.top, stored_. simpl. rewrite Rabs_R1, (Rmax_left 1 1), Rmax_left; lra. }
  constructor; try assumption; try apply rnd_float; try apply Ft; try apply Rle_refl;
    try apply generic_format_0.
  - lra.
  - rewrite Tp, Rplus_0_r. apply (bpow_le radix2 (-1009) 0). lia.
  - rewrite Tp. assert (V : bpow radix2 60 * u = 128) by (rewrite u_value; simpl; lra).
    assert (bpow radix2 60 * (240 * u) <= bpow radix2 60 * place_of' size).
    { apply Rmult_le_compat_l; [apply bpow_ge_0 | exact E1]. } lra.
Qed.

(** ** What is decided of the pixel (i, j), of a ray and a triangle as they are stored *)
Section Decided.
Variables (a b c : vec) (Za Zb Zc from_here up_ right_ : R).
Hypothesis sees_a : sees a Za. Hypothesis sees_b : sees b Zb. Hypothesis sees_c : sees c Zc.
Hypothesis pixel_x : zx + right_ = IZR i + / 2.
Hypothesis pixel_y : zy + up_ = IZR j + / 2.
Hypothesis up_float : is_float up_. Hypothesis right_float : is_float right_.
Hypothesis from_float : is_float from_here. Hypothesis from_size : 1 <= from_here <= 4294967296.
Hypothesis up_in : Rabs up_ <= from_here. Hypothesis right_in : Rabs right_ <= from_here.
Let size := Rmax (Rmax Za Zb) Zc.
Let weight := rnd (0 * size).
Let A := EB.relative zx zy (stored' a).
Let B := EB.relative zx zy (stored' b).
Let C := EB.relative zx zy (stored' c).
Let far := EB.far_of (EB.span A B C) (place_of' size).
Let high := EB.high_of (EB.top A B C) weight.
Let T_ := EB.volume A B C.
Let t_max := EB.volume_error (place_of' size) weight far high.
Let e_max := EB.edge_error from_here (place_of' size) weight far high.
Let r := Ray oh forward.
Let tri := Triangle a b c.
Let at_edge s u v := EB.signed_edge s u v up_ right_.
Let least s := Rmin (Rmin (at_edge s B C) (at_edge s C A)) (at_edge s A B).

Lemma fits : E.fit (place_of' size) weight from_here A B C
  (E.moved zx zy (see a)) (E.moved zx zy (see b)) (E.moved zx zy (see c)).
Proof. apply parallel_fit; assumption. Qed.
Lemma at_pixel u v : det (E.moved zx zy u) (E.moved zx zy v) (ER.pixel_ray up_ right_) =
  det u v (V (IZR i + / 2) (IZR j + / 2) 1).
Proof.
  rewrite <- (E.moved_det zx zy u v (IZR i + / 2) (IZR j + / 2)).
  replace up_ with (IZR j + / 2 - zy) by lra. replace right_ with (IZR i + / 2 - zx) by lra. reflexivity.
Qed.
Lemma determinants : exists k, k <> 0 /\
  (let e u v := k * det (see u) (see v) (V (IZR i + / 2) (IZR j + / 2) 1) in
   edge r a b = e a b /\ edge r b c = e b c /\ edge r c a = e c a) /\
  denominator r tri = k * det (see a) (see b) (see c).
Proof.
  assert (V0 : volume right up forward <> 0) by (eapply O.solid; eassumption).
  destruct (Window.axes_ok x0 x1 y0 y1 width height sizes pixels) as [Ax Ay].
  assert (PX := pixel_pos ax Ax). assert (PY := pixel_pos ay Ay).
  exists (volume right up forward * (pixel ax * pixel ay)). split; [|split].
  - apply Rmult_integral_contrapositive. split; [exact V0|]. apply Rmult_integral_contrapositive. lra.
  - unfold r. repeat split; apply parallel_edge; assumption.
  - apply parallel_volume; assumption.
Qed.

(** What is sure to be inside: the line of the ray meets the triangle, at no edge. *)
Theorem surely_inside' (s := EB.sign_of T_) : Rabs T_ > t_max ->
  at_edge s B C > e_max -> at_edge s C A > e_max -> at_edge s A B > e_max -> meets_inside r tri.
Proof.
  intros H1 H2 H3 H4.
  destruct (E.sure_inside _ _ _ _ _ _ _ _ _ fits up_ right_ up_float right_float up_in right_in H1 H2 H3 H4)
    as [T0 [e_bc [e_ca [e_ab D]]]].
  rewrite E.moved_volume, !at_pixel in *. destruct determinants as [k [K0 [[E1 [E2 E3]] N]]].
  unfold meets_inside, tri. cbn [ca cb cc]. rewrite E1, E2, E3. eapply all_inside; eassumption.
Qed.

(** What is dropped: it does not, be T sure, or be it dropped by the set-ups of both signs. *)
Theorem dropped' (s := EB.sign_of T_) : Rabs T_ > t_max -> least s < - e_max -> ~ meets r tri.
Proof.
  intros H1 H2 [D M].
  apply (E.nothing_lost _ _ _ _ _ _ _ _ _ fits up_ right_ up_float right_float up_in right_in H1 H2).
  rewrite E.moved_volume, !at_pixel. destruct determinants as [k [K0 [[E1 [E2 E3]] N]]].
  set (T := det (see a) (see b) (see c)) in *.
  assert (DD : denominator r tri = edge r a b + edge r b c + edge r c a) by apply denominator_sum.
  unfold tri in M. cbn [ca cb cc] in M. rewrite N in D, DD. rewrite E1, E2, E3 in M, DD.
  destruct M as [[M1 [M2 M3]]|[M1 [M2 M3]]].
  - assert (0 < k * T) by lra. repeat split; eapply same_sign; eassumption.
  - assert (k * T < 0) by lra. repeat split; eapply same_sign'; eassumption.
Qed.
Theorem dropped_by_both' : least 1 < - e_max -> least (-1) < - e_max -> ~ meets r tri.
Proof.
  intros H1 H2 [_ M].
  destruct (E.nothing_lost_unsure _ _ _ _ _ _ _ _ _ fits up_ right_ up_float right_float up_in right_in H1 H2)
    as [L1 L2]. rewrite !at_pixel in L1, L2.
  destruct determinants as [k [K0 [[E1 [E2 E3]] N]]].
  unfold tri in M. cbn [ca cb cc] in M. rewrite E1, E2, E3 in M.
  destruct M as [[M1 [M2 M3]]|[M1 [M2 M3]]]; apply (keeps_sign k) in M1, M2, M3; try exact K0; lra.
Qed.
End Decided.
End Parallel.
