(** An orthographic camera, from its stored numbers: [place], [depth_error] and the ray's functions.

    As [Perspective.v], with two hypotheses more. [well_apart]: the axes are further from a plane than
    [has_sound_axes] asks, as here a factor of the dual axes does move things ([Dual.v]). And the
    window or the position is not microscopic ([some_length]). *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Camera Place Film Dual Bounds Boxes.
From Reftrace Require Import Window.
Open Scope R_scope.
Opaque rnd.

Section Orthographic.
Variables right up forward o : vec.
Hypothesis axes_float : floats right /\ floats up /\ floats forward.
Hypothesis o_float : floats o.
Hypothesis lengths : dot right right <= 401 / 100 /\ dot up up <= 401 / 100 /\ dot forward forward <= 401 / 100.
Hypothesis not_flat : 1249 / 10000 <= Rabs (volume right up forward).
Hypothesis well_apart : permanent right up forward <= 119 / 10 * Rabs (volume right up forward).
Variables m most : R. (* the largest |.| of the axes' components, and of the position's *)
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
Hypothesis pixels : bpow radix2 (-1020) <= pixel ax <= bpow radix2 1000 /\ bpow radix2 (-1020) <= pixel ay <= bpow radix2 1000.
Hypothesis some_length : bpow radix2 (-900) <= ray_length' m ax ay most.

Definition re' := ray_error S (length' m most (rnd (reach ax + reach ay))).
Definition place_constant := Rmax (Rmax 0 (constant' (film_error x0 (pixel ax) n n') re' (pixel ax)))
  (constant' (film_error y0 (pixel ay) n n') re' (pixel ay)).
Definition place_slope' := Rmax (Rmax 0 (slope' S (pixel ax))) (slope' S (pixel ay)).

Notation counts := (Window.counts width height sizes).
Notation axes_ok := (Window.axes_ok x0 x1 y0 y1 width height sizes pixels).
Lemma S_some : 1 <= S /\ S <= 200.
Proof. split; eapply k_S; try eassumption; apply m_range. Qed.

Lemma re_enough : 47 * (u * (S * ray_length' m ax ay most)) <= re'.
Proof.
  destruct axes_ok as [[_ [_ RX]] [_ [_ RY]]]. destruct S_some as [HS _]. assert (M := m_range).
  assert (P := u_pos). assert (E := eta_u6). assert (Pe := eta_pos). assert (T := u_tiny).
  set (r := ray_length' m ax ay most) in *. set (sum := reach ax + reach ay) in *.
  assert (R : r = most + m * sum) by (unfold r, sum, ray_length'; ring).
  assert (mo : 0 <= most) by (eapply Rle_trans; [apply Rabs_pos | apply o_within]).
  assert (s0 : 0 <= sum) by (unfold sum; lra).
  assert (ms : 0 <= m * sum) by (apply Rmult_le_pos; lra).
  assert (A := lo1 sum s0). assert (A0 := rnd_pos sum s0).
  assert (B0 : 0 <= m * rnd sum) by (apply Rmult_le_pos; lra).
  assert (B := lo1 (m * rnd sum) B0). assert (B1 := rnd_pos _ B0).
  assert (C : m * (9999 / 10000 * sum - eta) <= m * rnd sum) by (apply Rmult_le_compat_l; lra).
  assert (me : m * eta <= 201 / 100 * eta) by (apply Rmult_le_compat_r; lra).
  assert (D := lo1 (most + rnd (m * rnd sum)) ltac:(lra)).
  assert (L : 9995 / 10000 * r - 10 * eta <= length' m most (rnd sum)) by (unfold length'; lra).
  assert (er : eta <= u * r / 1000000).
  { apply Rle_trans with (u * bpow radix2 (-900) / 1000000).
    - unfold eta, u. replace (-1074)%Z with (-122 + (-52 + -900))%Z by reflexivity. rewrite !bpow_plus.
      assert (bpow radix2 (-122) <= / 1000000).
      { apply Rle_trans with (bpow radix2 (-20)); [apply bpow_le; lia | simpl; lra]. }
      assert (0 < bpow radix2 (-52) * bpow radix2 (-900)) by (apply Rmult_lt_0_compat; apply bpow_gt_0). nra.
    - apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; lra. }
  assert (r0 : 0 <= r) by lra.
  assert (ur : u * r <= / 1000000 * r) by (apply Rmult_le_compat_r; lra).
  assert (G := error_of_length S (length' m most (rnd sum)) r HS ltac:(lra) r0 ltac:(lra)).
  unfold re'. fold sum.
  assert (u * r <= u * (S * r)).
  { apply Rmult_le_compat_l; [lra|]. assert (1 * r <= S * r) by (apply Rmult_le_compat_r; lra). lra. }
  assert (u * (S * eta) <= u * (S * (r * / 1000000))).
  { apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; lra. } lra.
Qed.

Lemma re_pos : 0 <= re'.
Proof.
  eapply Rle_trans; [|exact re_enough]. assert (B := bpow_gt_0 radix2 (-900)). assert (L := some_length).
  destruct S_some as [HS _]. assert (P := u_pos). repeat (lra || apply Rmult_le_pos).
Qed.
Lemma place_bounds : let s a b := constant_of' re' a b in let t a := slope_of' S a in
  98 / 100 * s ax ay <= place_constant /\ 98 / 100 * t ax <= place_slope' /\
  98 / 100 * s ay ax <= place_constant /\ 98 / 100 * t ay <= place_slope' /\
  0 <= place_constant /\ 0 <= place_slope'.
Proof.
  intros s t. destruct axes_ok as [Ax Ay]. destruct counts as [N1 [N2 _]]. destruct S_some as [HS _].
  destruct (place_holds' ax Ax n n' N1 N2 S re' HS re_pos) as [Sx Cx].
  destruct (place_holds' ay Ay n n' N1 N2 S re' HS re_pos) as [Sy Cy].
  split; [|split; [|split; [|split; [|split]]]].
  - eapply Rle_trans; [exact Cx|]. unfold place_constant. eapply Rle_trans; [apply Rmax_r | apply Rmax_l].
  - eapply Rle_trans; [exact Sx|]. unfold place_slope'. eapply Rle_trans; [apply Rmax_r | apply Rmax_l].
  - eapply Rle_trans; [|unfold place_constant; apply Rmax_r]. eapply Rle_trans; [|exact Cy].
    right. unfold s, constant_of'; simpl. ring.
  - eapply Rle_trans; [exact Sy|]. unfold place_slope'. apply Rmax_r.
  - unfold place_constant. eapply Rle_trans; [apply Rmax_l | apply Rmax_l].
  - unfold place_slope'. eapply Rle_trans; [apply Rmax_l | apply Rmax_l].
Qed.
Lemma duals_near : off_by 1 Dr (dual_right right up forward) <= 100 * (u * S) /\
  off_by 1 Du (dual_up right up forward) <= 100 * (u * S) /\
  off_by 1 Df (dual_depth right up forward) <= 100 * (u * S) /\ Rabs (1 - 1) <= / 100.
Proof. now apply (exactly_near right up forward m S). Qed.

Variables (i j : Z) (dx dy : R).
Hypothesis i_pixel : (0 <= i < width)%Z.
Hypothesis j_pixel : (0 <= j < height)%Z.
Hypothesis shift : Rabs dx <= / 2 /\ Rabs dy <= / 2.

Notation in_picture_both :=
  (Window.in_picture_both x0 x1 y0 y1 width height sizes window_ok pixels i j dx dy i_pixel j_pixel shift).
Notation in_picture_x := (proj1 in_picture_both).
Notation in_picture_y := (proj2 in_picture_both).

(** The ray's origin as [camera_rays] stores it; its direction is [forward]. *)
Definition oh := fdirection (window_at x0 (film_at (IZR i) dx) (pixel ax)) (window_at y0 (film_at (IZR j) dy) (pixel ay)) right up o.
Notation see := (seen' right up forward x0 y0 (pixel ax) (pixel ay) dx dy o oh (IZR i + / 2) (IZR j + / 2)).

Lemma solid : volume right up forward <> 0.
Proof. eapply vol_not_0; eassumption. Qed.

Theorem vertex_near' v V O : floats v -> within v V -> within o O -> let Z := vertex_size V O in
  near (film_position (fdot Dr (fsub v o)) 1 x0 (pixel ax) dx) (vx (see v)) (92 / 100 * (place_constant + place_slope' * Z)) /\
  near (film_position (fdot Du (fsub v o)) 1 y0 (pixel ay) dy) (vy (see v)) (92 / 100 * (place_constant + place_slope' * Z)) /\
  near (fdot Df (fsub v o)) (depth' right up forward o oh v) (92 / 100 * (2 * re' + weight S * Z)).
Proof.
  intros Fv WV WO Z. destruct (size_holds v o V O WV WO) as [HZ Z0]. fold Z in HZ, Z0.
  assert (Zp : 0 < Z) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact Z0]).
  destruct axes_ok as [Ax Ay]. destruct S_some as [HS HS']. assert (P := u_pos). destruct counts as [N1 [N2 _]].
  assert (E := eta_u6). assert (Pe := eta_pos). assert (T := u_tiny).
  assert (RE := re_pos).
  destruct axes_float as [Fr [Fu Ff]].
  assert (Sp := spread_enough right up forward S S_sum).
  destruct duals_near as [Nr0 [Nr1 [Nr2 One]]]. assert (Nr := conj Nr0 (conj Nr1 Nr2)).
  destruct (parallel_place right up forward o solid (conj Fr (conj Fu (conj Ff o_float))) m axes_within (proj1 m_range)
    Dr Du Df 1 S (dual_floats right up forward) Nr Sp HS One ax ay Ax Ay eq_refl HS' re' most o_within re_enough
    (IZR i) (IZR j) dx dy in_picture_x in_picture_y v Z Fv HZ Z0) as [Gx [Gy Gd]].
  destruct place_bounds as [Cx' [Sx0 [Cy' [Sy0 _]]]].
  assert (G0 : forall a b, axis_ok a -> axis_ok b -> 0 <= constant_of' re' a b /\ 0 <= slope_of' S a).
  { intros a b A [_ [Nb _]]. assert (K := k_pos a A). destruct A as [_ [Na RX]]. unfold constant_of', slope_of', Rdiv.
    assert (0 <= Rabs (start a) * / pixel a) by (apply Rmult_le_pos; [apply Rabs_pos | lra]).
    assert (0 <= u * (Rabs (start a) * / pixel a + count a + count b)) by (apply Rmult_le_pos; lra).
    assert (0 <= re' * / pixel a) by (apply Rmult_le_pos; lra).
    split; [lra|]. repeat (lra || apply Rmult_le_pos). }
  destruct (G0 ax ay Ax Ay) as [Px Qx]. destruct (G0 ay ax Ay Ax) as [Py Qy].
  assert (Sx' : 98 / 100 * slope_of' S ax * Z <= place_slope' * Z) by (apply Rmult_le_compat_r; lra).
  assert (Sy' : 98 / 100 * slope_of' S ay * Z <= place_slope' * Z) by (apply Rmult_le_compat_r; lra).
  assert (Qx' : 0 <= slope_of' S ax * Z) by (apply Rmult_le_pos; lra).
  assert (Qy' : 0 <= slope_of' S ay * Z) by (apply Rmult_le_pos; lra).
  split; [|split].
  - eapply near_le; [exact Gx | lra].
  - eapply near_le; [exact Gy | lra].
  - eapply near_le; [exact Gd|]. assert (W := weight_holds S HS).
    assert (uS : u * 1 <= u * S) by (apply Rmult_le_compat_l; lra).
    assert (W1 : 999 / 1000 * (128 * u * S) * Z <= weight S * Z) by (apply Rmult_le_compat_r; lra).
    assert (0 <= u * S * Z) by (repeat (lra || apply Rmult_le_pos)). lra.
Qed.

(** ** What the ray meets is a mean of the corners, and boxes *)
Notation t_of a b c := (Geometry.depth (Ray oh forward) (Triangle a b c)).
Lemma corners_around' a b c : meets (Ray oh forward) (Triangle a b c) ->
  let f v := vx (see v) - (IZR i + / 2) in let g v := vy (see v) - (IZR j + / 2) in
  let behind v := depth' right up forward o oh v - t_of a b c in
  (f a <= 0 \/ f b <= 0 \/ f c <= 0) /\ (0 <= f a \/ 0 <= f b \/ 0 <= f c) /\
  (g a <= 0 \/ g b <= 0 \/ g c <= 0) /\ (0 <= g a \/ 0 <= g b \/ 0 <= g c) /\
  (behind a <= 0 \/ behind b <= 0 \/ behind c <= 0).
Proof.
  intros H f g behind. destruct (meets_mean _ _ H) as [k0 [k1 [k2 [I [J [K [One E]]]]]]].
  destruct axes_ok as [Ax Ay]. cbn [ca cb cc] in E. 
  destruct (seen_at' right up forward solid x0 y0 (pixel ax) (pixel ay) dx dy (pixel_pos ax Ax) (pixel_pos ay Ay) o oh
    (IZR i + / 2) (IZR j + / 2) (t_of a b c)) as [F D].
  rewrite E in F, D.
  destruct (seen_mean' right up forward x0 y0 (pixel ax) (pixel ay) dx dy (pixel_pos ax Ax) (pixel_pos ay Ay) o oh
    (IZR i + / 2) (IZR j + / 2) k0 k1 k2 a b c One) as [F' D'].
  rewrite F in F'. rewrite D in D'. assert (Fx := f_equal vx F'). assert (Fy := f_equal vy F'). clear F F' D E.
  cbn [vadd vscale vx vy] in Fx, Fy.
  assert (X : k0 * f a + k1 * f b + k2 * f c = 0).
  { unfold f. transitivity (k0 * vx (see a) + (k1 * vx (see b) + k2 * vx (see c)) - (k0 + k1 + k2) * (IZR i + / 2)); [ring|].
    rewrite <- Fx, One. ring. }
  assert (Y : k0 * g a + k1 * g b + k2 * g c = 0).
  { unfold g. transitivity (k0 * vy (see a) + (k1 * vy (see b) + k2 * vy (see c)) - (k0 + k1 + k2) * (IZR j + / 2)); [ring|].
    rewrite <- Fy, One. ring. }
  assert (W : k0 * behind a + k1 * behind b + k2 * behind c = 0).
  { unfold behind. transitivity (k0 * depth' right up forward o oh a + k1 * depth' right up forward o oh b +
      k2 * depth' right up forward o oh c - (k0 + k1 + k2) * t_of a b c); [ring|]. rewrite <- D', One. ring. }
  assert (O : forall h : vec -> R, k0 * h a + k1 * h b + k2 * h c = 0 -> 0 <= h a \/ 0 <= h b \/ 0 <= h c).
  { intros h Hh. destruct (one_not_above k0 k1 k2 (- h a) (- h b) (- h c) I J K One ltac:(lra)) as [?|[?|?]]; lra. }
  split; [|split; [|split; [|split]]]; auto; apply (one_not_above k0 k1 k2); auto; lra.
Qed.

Variables far K : R.
Hypothesis far_is : 2 * n <= far /\ 2 * n' <= far /\ far <= 2 * (n + n').
Hypothesis K_value : 10099 / 10000 <= K.
Notation p v := (film_position (fdot Dr (fsub v o)) 1 x0 (pixel ax) dx).
Notation q v := (film_position (fdot Du (fsub v o)) 1 y0 (pixel ay) dy).
Definition low_x v Z := lowest place_constant place_slope' 0 Z far K (p v) 1 n.
Definition high_x v Z := highest place_constant place_slope' 0 Z far K (p v) 1 n.
Definition low_y v Z := lowest place_constant place_slope' 0 Z far K (q v) 1 n'.
Definition high_y v Z := highest place_constant place_slope' 0 Z far K (q v) 1 n'.

Lemma corner v V O (Z := vertex_size V O) : floats v -> within v V -> within o O ->
  (vx (see v) - (IZR i + / 2) <= 0 -> low_x v Z <= IZR i) /\ (0 <= vx (see v) - (IZR i + / 2) -> high_x v Z <= - IZR i) /\
  (vy (see v) - (IZR j + / 2) <= 0 -> low_y v Z <= IZR j) /\ (0 <= vy (see v) - (IZR j + / 2) -> high_y v Z <= - IZR j).
Proof.
  intros Fv WV WO. destruct (vertex_near' v V O Fv WV WO) as [X [Y _]]. fold Z in X, Y.
  destruct (size_holds v o V O WV WO) as [_ Z0]. fold Z in Z0.
  assert (Zp : 0 <= Z) by (generalize (bpow_gt_0 radix2 (-970)); lra).
  assert (One : near 1 1 (92 / 100 * (0 * Z))) by (eapply near_le; [apply near_refl | lra]).
  assert (E : eta <= u * 1 / 1000) by (generalize eta_u6 u_pos; lra).
  destruct place_bounds as [_ [_ [_ [_ [C0 S0]]]]].
  destruct axes_ok as [Ax Ay]. destruct S_some as [HS _]. destruct counts as [N1 [N2 _]]. assert (P := u_pos).
  assert (RE := re_pos).
  assert (Ps : 50 * u * far * 1 <= place place_constant place_slope' Z).
  { destruct (place_holds' ax Ax n n' N1 N2 S re' HS RE) as [_ Cx]. assert (Kp := k_pos ax Ax). unfold Rdiv in Cx.
    assert (0 <= Rabs (start ax) * / pixel ax) by (apply Rmult_le_pos; [apply Rabs_pos | lra]).
    assert (0 <= re' * / pixel ax) by (apply Rmult_le_pos; lra).
    assert (0 <= u * (Rabs (start ax) * / pixel ax)) by (apply Rmult_le_pos; lra).
    assert (Cx' : constant' (film_error x0 (pixel ax) n n') re' (pixel ax) <= place_constant).
    { unfold place_constant. eapply Rle_trans; [apply Rmax_r | apply Rmax_l]. }
    simpl start in *. unfold place. assert (0 <= place_slope' * Z) by (apply Rmult_le_pos; lra).
    assert (u * far <= u * (2 * (n + n'))) by (apply Rmult_le_compat_l; lra).
    assert (0 <= u * (n + n')) by (apply Rmult_le_pos; lra). lra. }
  destruct far_is as [F1 [F2 F3]].
  split; [|split; [|split]]; intros H.
  - refine (at_least place_constant place_slope' 0 Z far K K_value (p v) 1 _ _ X One Rlt_0_1 E width (proj1 sizes) F1 C0 S0 Zp (or_introl eq_refl) Ps i i_pixel _). lra.
  - refine (at_most place_constant place_slope' 0 Z far K K_value (p v) 1 _ _ X One Rlt_0_1 E width (proj1 sizes) F1 C0 S0 Zp (or_introl eq_refl) Ps i i_pixel _). lra.
  - refine (at_least place_constant place_slope' 0 Z far K K_value (q v) 1 _ _ Y One Rlt_0_1 E height (proj2 sizes) F2 C0 S0 Zp (or_introl eq_refl) Ps j j_pixel _). lra.
  - refine (at_most place_constant place_slope' 0 Z far K K_value (q v) 1 _ _ Y One Rlt_0_1 E height (proj2 sizes) F2 C0 S0 Zp (or_introl eq_refl) Ps j j_pixel _). lra.
Qed.

Theorem box_holds' a b c Va Vb Vc O (Za := vertex_size Va O) (Zb := vertex_size Vb O) (Zc := vertex_size Vc O) :
  floats a -> within a Va -> floats b -> within b Vb -> floats c -> within c Vc -> within o O ->
  meets (Ray oh forward) (Triangle a b c) ->
  Rmin (low_x a Za) (Rmin (low_x b Zb) (low_x c Zc)) <= IZR i /\
  Rmin (high_x a Za) (Rmin (high_x b Zb) (high_x c Zc)) <= - IZR i /\
  Rmin (low_y a Za) (Rmin (low_y b Zb) (low_y c Zc)) <= IZR j /\
  Rmin (high_y a Za) (Rmin (high_y b Zb) (high_y c Zc)) <= - IZR j.
Proof.
  intros Fa Wa Fb Wb Fc Wc Wo M. destruct (corners_around' a b c M) as [F [F' [G [G' _]]]].
  apply (box_of_three low_x high_x low_y high_y
    (fun v => vx (see v) - (IZR i + / 2)) (fun v => vy (see v) - (IZR j + / 2))).
  - exact (conj F (conj F' (conj G G'))).
  - exact (corner a Va O Fa Wa Wo).
  - exact (corner b Vb O Fb Wb Wo).
  - exact (corner c Vc O Fc Wc Wo).
Qed.

(** Nothing that is met is nearer, in -t, than the largest [nearest] of the corners. *)
Theorem nearest_seen' a b c Va Vb Vc O (near_v := fun v V => nearest' (fdot Df (fsub v o)) (vertex_size V O) (2 * re') (weight S)) :
  floats a -> within a Va -> floats b -> within b Vb -> floats c -> within c Vc -> within o O ->
  meets (Ray oh forward) (Triangle a b c) -> - t_of a b c <= Rmax (near_v a Va) (Rmax (near_v b Vb) (near_v c Vc)).
Proof.
  intros Fa Wa Fb Wb Fc Wc Wo M. destruct (corners_around' a b c M) as [_ [_ [_ [_ B]]]].
  assert (G : forall v V, floats v -> within v V -> depth' right up forward o oh v - t_of a b c <= 0 -> - t_of a b c <= near_v v V).
  { intros v V Fv WV D. destruct (vertex_near' v V O Fv WV Wo) as [_ [_ W]].
    destruct (size_holds v o V O WV Wo) as [HZ Z0]. set (Z := vertex_size V O) in *.
    assert (Zp : 0 < Z) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact Z0]).
    destruct S_some as [HS _]. assert (P := u_pos). assert (E := eta_u6).
    destruct duals_near as [_ [_ [Nr One]]].
    destruct (coordinate o o_float 1 S HS One v Z Fv HZ Z0 Df _ (proj2 (proj2 (dual_floats right up forward)))
      Nr (proj2 (proj2 (spread_enough right up forward S S_sum)))) as [C1 C2].
    assert (Bd := near_abs _ _ _ _ C1 C2). assert (Et := eta_unit S HS Z Z0).
    assert (RE := re_pos).
    assert (Wt := weight_holds S HS). assert (uS : u * 1 <= u * S) by (apply Rmult_le_compat_l; lra).
    assert (W1 : 127 * (u * S) * Z <= weight S * Z) by (apply Rmult_le_compat_r; lra).
    assert (SZ : 0 < S * Z) by (apply Rmult_lt_0_compat; lra). assert (T := u_tiny).
    assert (uSZ : 0 < u * (S * Z)) by (apply Rmult_lt_0_compat; lra).
    assert (u * (S * Z) <= / 1000000 * (S * Z)) by (apply Rmult_le_compat_r; lra).
    assert (u * Rabs (fdot Df (fsub v o)) <= u * (102 / 100 * (S * Z))) by (apply Rmult_le_compat_l; lra).
    unfold near_v. fold Z. apply (nearest_holds' _ (depth' right up forward o oh v)); try exact W; lra. }
  apply greatest_of_three. destruct B as [B|[B|B]].
  - left. exact (G a Va Fa Wa B).
  - right. left. exact (G b Vb Fb Wb B).
  - right. right. exact (G c Vc Fc Wc B).
Qed.
End Orthographic.
