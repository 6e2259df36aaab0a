(** The fourth function, how near a triangle is at a pixel: what is common to both projections.

    See "A triangle as four linear functions of the pixel" in docs/speed.md; the code is the second half
    of `set_up` in edge_functions.py. It is asked where T is sure: |T| > error. Here are the formulas,
    what rounding does to a coefficient and to the function at a pixel, and the edge functions in the
    units of their bounds. NearnessPerspective.v and NearnessParallel.v have the bounds.

    As in EdgeFunctions.v all is as if there were no largest float. A quotient by |T| may exceed it, but
    only for corners whose w is some 2^-960: then NaN comes out, of which no comparison holds, so that
    nothing is dropped. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding EdgeFunctions.
Open Scope R_scope.

(** ** What is computed *)

(** Perspective: the coefficients of the three edges, summed and divided by |T|; and the bound. *)
Definition summed (amount f0 f1 f2 : R) : R := rnd (rnd (rnd (f0 + f1) + f2) / amount).
Definition perspective_error (e_max t_max amount ray_error nearest : R) : R :=
  let least := rnd (amount - t_max) in
  let relative := rnd (rnd (t_max / least) + rnd (rnd (2 * ray_error) + 16 * u)) in
  rnd (rnd (rnd (rnd (6 * e_max) / least) + rnd (relative * nearest)) * more).

(** Parallel rays: b and c are the depths of those corners, less that of the first, [base]. *)
Definition mixed (amount f1 f2 b c : R) : R := rnd (rnd (rnd (f1 * b) + rnd (f2 * c)) / (- amount)).
Definition parallel_error (e_max t_max amount b c own : R) : R :=
  let least := rnd (amount - t_max) in
  rnd (rnd (rnd (rnd (rnd (6 * rnd (e_max + t_max)) / least) * rnd (Rmax (Rabs b) (Rabs c) + rnd (2 * own)))
            + rnd (4 * own)) * more).

(** ** Roundings *)

Local Opaque u eta.
Ltac pos := repeat first [assumption | apply Rabs_pos | apply Rplus_le_le_0_compat | apply Rmult_le_pos |
  lra].

Lemma rnd_near x : Rabs (rnd x) <= 1.0001 * Rabs x + eta.
Proof.
  replace (rnd x) with (x + (rnd x - x)) by ring. eapply Rle_trans; [apply Rabs_triang|].
  assert (E := rnd_err x). assert (U := u_small). assert (P := u_pos).
  assert (u * Rabs x <= 0.0001 * Rabs x) by (apply Rmult_le_compat_r; [apply Rabs_pos | lra]). lra.
Qed.

Lemma eta_u : eta <= 1/1000 * u.
Proof.
  assert (E : eta = / 2 * bpow radix2 (-1074)) by reflexivity. rewrite u_bpow, E.
  change (-53)%Z with (1021 + -1074)%Z. rewrite (bpow_plus _ 1021).
  assert (H : bpow radix2 10 <= bpow radix2 1021) by (apply bpow_le; lia).
  change (bpow radix2 10) with 1024 in H.
  assert (1024 * bpow radix2 (-1074) <= bpow radix2 1021 * bpow radix2 (-1074))
    by (apply Rmult_le_compat_r; [apply bpow_ge_0 | exact H]). generalize (bpow_gt_0 radix2 (-1074)). lra.
Qed.

Lemma scaled_off l x y k : 0 <= l -> Rabs (x - y) <= k -> - (l * k) <= l * x - l * y <= l * k.
Proof. intros L H. apply Rabs_le_inv in H. split; nra. Qed.
Lemma quotient_sign v t : t <> 0 -> 0 <= t * v -> 0 <= v / t.
Proof.
  intros T H. replace (v / t) with (t * v / (t * t)) by (field; exact T).
  apply Rmult_le_pos; [exact H|]. apply Rlt_le, Rinv_0_lt_compat. nra.
Qed.

(** A coefficient: the difference of two products. *)
Lemma difference_off p q r s P Q : Rabs p * Rabs q <= P -> Rabs r * Rabs s <= Q ->
  Rabs (rnd (rnd (p * q) - rnd (r * s)) - (p * q - r * s)) <= 2.001 * (u * (P + Q)) + 3 * eta.
Proof.
  rewrite <- !Rabs_mult. intros HP HQ. assert (U := u_small). assert (V := u_pos). assert (N := eta_pos).
  assert (E1 := rnd_err (p * q)). assert (E2 := rnd_err (r * s)).
  assert (F1 := rnd_near (p * q)). assert (F2 := rnd_near (r * s)).
  assert (E3 := rnd_err_sum (rnd (p * q)) (- rnd (r * s)) (rnd_float _) (is_float_opp _ (rnd_float _))).
  set (x := rnd (p * q)) in *. set (y := rnd (r * s)) in *. change (x + - y) with (x - y) in E3.
  assert (G1 : Rabs (x - p * q) <= u * P + eta) by (assert (u * Rabs (p * q) <= u * P)
    by (apply Rmult_le_compat_l; lra); lra).
  assert (G2 : Rabs (y - r * s) <= u * Q + eta) by (assert (u * Rabs (r * s) <= u * Q)
    by (apply Rmult_le_compat_l; lra); lra).
  assert (G3 : Rabs (x - y) <= 1.0001 * (P + Q) + 2 * eta).
  { unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (u * Rabs (x - y) <= u * (1.0001 * (P + Q) + 2 * eta)) by (apply Rmult_le_compat_l; lra).
  assert (u * eta <= 0.0001 * eta) by (apply Rmult_le_compat_r; lra).
  assert (0 <= u * (P + Q)). { apply Rmult_le_pos; [lra|]. generalize (Rabs_pos (p * q)) (Rabs_pos (r * s)).
  lra. }
  apply Rabs_le_inv in G1, G2, E3. apply Rabs_le. lra.
Qed.

(** The value at a pixel. *)
Lemma at_pixel_off c1 cy cx up right r : is_float c1 -> Rabs up <= r -> Rabs right <= r ->
  Rabs (at_pixel c1 cy cx up right - (c1 + cy * up + cx * right))
  <= 3.001 * (u * (Rabs c1 + r * Rabs cy + r * Rabs cx)) + 3 * eta.
Proof.
  intros F Hu Hr. assert (U := u_small). assert (V := u_pos). assert (N := eta_pos). unfold at_pixel.
  assert (Py : Rabs (cy * up) <= r * Rabs cy).
  { rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos | easy]. }
  assert (Px : Rabs (cx * right) <= r * Rabs cx).
  { rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos | easy]. }
  set (a := Rabs c1) in *. set (y := r * Rabs cy) in *. set (x := r * Rabs cx) in *.
  assert (0 <= a) by apply Rabs_pos. assert (0 <= y /\ 0 <= x) as [Y0 X0].
  { split; (eapply Rle_trans; [apply Rabs_pos | eassumption]). }
  assert (E1 := rnd_err (cy * up)). assert (E2 := rnd_err (cx * right)).
  set (p := rnd (cy * up)) in *. set (q := rnd (cx * right)) in *.
  assert (u * Rabs (cy * up) <= u * y) by (apply Rmult_le_compat_l; lra).
  assert (u * Rabs (cx * right) <= u * x) by (apply Rmult_le_compat_l; lra).
  assert (u * y <= 0.0001 * y /\ u * x <= 0.0001 * x /\ u * a <= 0.0001 * a /\ u * eta <= 0.0001 * eta)
    as [Uy [Ux [Ua Ue]]]
    by (repeat split; apply Rmult_le_compat_r; lra).
  assert (0 <= u * y /\ 0 <= u * x /\ 0 <= u * a) as [Vy [Vx Va]] by (repeat split; apply Rmult_le_pos; lra).
  assert (E3 := rnd_err_sum c1 p F (rnd_float _)). set (s := rnd (c1 + p)) in *.
  assert (Q1 : Rabs p <= 1.0001 * y + eta).
  { replace p with ((p - cy * up) + cy * up) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Q2 : Rabs q <= 1.0001 * x + eta).
  { replace q with ((q - cx * right) + cx * right) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Q3 : Rabs (c1 + p) <= a + 1.0001 * y + eta) by (eapply Rle_trans; [apply Rabs_triang|]; fold a;
    lra).
  assert (u * Rabs (c1 + p) <= u * (a + 1.0001 * y + eta)) by (apply Rmult_le_compat_l; lra).
  assert (Q4 : Rabs s <= 1.0001 * a + 1.0003 * y + 1.1 * eta).
  { replace s with ((s - (c1 + p)) + (c1 + p)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (E4 := rnd_err_sum s q (rnd_float _) (rnd_float _)).
  assert (Q5 : Rabs (s + q) <= 1.0001 * a + 1.0003 * y + 1.0001 * x + 2.1 * eta) by (eapply Rle_trans;
    [apply Rabs_triang|]; lra).
  assert (u * Rabs (s + q) <= u * (1.0001 * a + 1.0003 * y + 1.0001 * x + 2.1 * eta))
    by (apply Rmult_le_compat_l; lra).
  apply Rabs_le_inv in E1, E2, E3, E4. apply Rabs_le. lra.
Qed.

(** ** The edges again, in the units of their bounds *)

Section Near.
Variables (place weight reach : R) (a b c a' b' c' : vec).
Hypothesis ok : fit place weight reach a b c a' b' c'.
Variables up right : R.
Hypothesis in_up : Rabs up <= reach. Hypothesis in_right : Rabs right <= reach.
Let far := far_of (span a b c) place.
Let high := high_of (top a b c) weight.
Let e_max := edge_error reach place weight far high.
Let t_max := volume_error place weight far high.
Let amount := Rabs (volume a b c).
Let s := sign_of (volume a b c).
Hypothesis sure : amount > t_max.
Let d := pixel_ray up right.
Let T := det a' b' c'.
Let e_bc := det b' c' d.
Let e_ca := det c' a' d.
Let e_ab := det a' b' d.

(** X is what the errors of the corners move, Y is what one rounding does: E >= X + 8 Y. *)
Let f := span a b c + place.
Let h := top a b c + weight.
Let X := 4 * reach * (place * h + f * weight) + 4 * (f * place).
Let Y := u * (4 * reach * (f * h) + 2 * (f * f)).

Lemma nonneg : 0 <= X /\ 0 <= Y /\ 1 <= reach <= 4294967296 /\ 0 <= f /\ 0 <= h.
Proof.
  destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [_ [_ [_ [_ [_ [Pm Pk]]]]]]. destruct ok. assert (U := u_pos).
  unfold X, Y, f, h. split; [|split; [|split]]; [pos | pos | easy | lra].
Qed.
Lemma unit_low : X + 8 * Y + 4/10 * tiny <= e_max.
Proof.
  destruct nonneg as [X0 [Y0 _]]. destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [_ [_ [_ [Fm [Fk [Pm Pk]]]]]].
  destruct ok.
  assert (H := edge_error_low _ _ _ _ _ Fm Fk f_place f_weight f_reach Pm Pk pos_place pos_weight size_reach
    not_tiny).
  fold far high e_max f h in H. fold X in H. assert (B := bpow_gt_0 radix2 (-1000)). fold tiny in B.
  unfold Y in *. lra.
Qed.

(** The function with the coefficients as computed, and how large these are. *)
Definition linear (v w : vec) : R := of_1 v w + of_y v w * up + of_x v w * right.
Definition sizes (v w : vec) : R := Rabs (of_1 v w) + reach * Rabs (of_y v w) + reach * Rabs (of_x v w).
Let slack := 20 * (reach * eta).

Lemma coefficients v w v' w' : within (span a b c) (top a b c) v -> within (span a b c) (top a b c) w ->
  close place weight v v' -> close place weight w w' ->
  Rabs (linear v w - det v' w' d) <= X + 2.001 * Y + slack /\ u * sizes v w <= 1.001 * Y + slack.
Proof.
  intros Wv Ww Cv Cw. destruct nonneg as [X0 [Y0 [R1 [F0 H0]]]].
  destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [_ [_ [_ [_ [_ [Pm Pk]]]]]]. destruct ok.
  assert (M := edge_moved v w v' w' up right _ _ place weight reach pos_place pos_weight Wv Ww Cv Cw in_up
    in_right).
  simpl in M. fold f h X d in M.
  destruct Wv as [Vx [Vy Vz]], Ww as [Wx [Wy Wz]].
  assert (U := u_small). assert (P := u_pos). assert (N := eta_pos).
  assert (Mf : span a b c <= f) by (unfold f; lra). assert (Mh : top a b c <= h) by (unfold h; lra).
  assert (B : forall x y p q, Rabs x <= p -> Rabs y <= q -> forall p' q', p <= p' -> q <= q' ->
    Rabs x * Rabs y <= p' * q')
    by (intros; apply product_le; lra).
  assert (D1 := difference_off (vx v) (vy w) (vy v) (vx w) (f * f) (f * f) ltac:(eapply B; eassumption)
    ltac:(eapply B; eassumption)).
  assert (Dy := difference_off (vz v) (vx w) (vx v) (vz w) (h * f) (f * h) ltac:(eapply B; eassumption)
    ltac:(eapply B; eassumption)).
  assert (Dx := difference_off (vy v) (vz w) (vz v) (vy w) (f * h) (h * f) ltac:(eapply B; eassumption)
    ltac:(eapply B; eassumption)).
  fold (of_1 v w) in D1. fold (of_y v w) in Dy. fold (of_x v w) in Dx.
  assert (Sz : forall x y X Y, Rabs x <= X -> Rabs y <= Y -> Rabs (x - y) <= X + Y).
  { intros x y A B' HA HB. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (Z1 : Rabs (vx v * vy w - vy v * vx w) <= f * f + f * f) by (apply Sz; rewrite Rabs_mult; eapply B;
    eassumption).
  assert (Zy : Rabs (vz v * vx w - vx v * vz w) <= h * f + f * h) by (apply Sz; rewrite Rabs_mult; eapply B;
    eassumption).
  assert (Zx : Rabs (vy v * vz w - vz v * vy w) <= f * h + h * f) by (apply Sz; rewrite Rabs_mult; eapply B;
    eassumption).
  set (q1 := vx v * vy w - vy v * vx w) in *. set (qy := vz v * vx w - vx v * vz w) in *.
  set (qx := vy v * vz w - vz v * vy w) in *.
  assert (Re : eta <= reach * eta) by (rewrite <- (Rmult_1_l eta) at 1; apply Rmult_le_compat_r; lra).
  assert (Ff : 0 <= f * f) by pos. assert (Fh : 0 <= f * h) by pos.
  split.
  - assert (Py := product_le _ _ _ _ Dy in_up). assert (Px := product_le _ _ _ _ Dx in_right).
    rewrite <- Rabs_mult in Py, Px.
    assert (Q : linear v w - det v w d = (of_1 v w - q1) + (of_y v w - qy) * up + (of_x v w - qx) * right)
      by (unfold linear, q1, qy, qx, det, dot, cross, d, pixel_ray; simpl; ring).
    apply Rabs_le_inv in D1, Py, Px, M. apply Rabs_le. unfold Y, slack. lra.
  - unfold sizes.
    assert (K : forall c q r, Rabs (c - q) <= 2.001 * (u * r) + 3 * eta -> Rabs q <= r -> Rabs c <= 1.001 * r
      + 3 * eta).
    { intros k q r H1 H2. replace k with ((k - q) + q) by ring. eapply Rle_trans; [apply Rabs_triang|].
      assert (u * r <= 0.0001 * r) by (apply Rmult_le_compat_r; [generalize (Rabs_pos q); lra | lra]).
      generalize (Rabs_pos q). lra. }
    assert (K1 := K _ _ _ D1 Z1). assert (Ky := K _ _ _ Dy Zy). assert (Kx := K _ _ _ Dx Zx).
    assert (reach * Rabs (of_y v w) <= reach * (1.001 * (h * f + f * h) + 3 * eta))
      by (apply Rmult_le_compat_l; lra).
    assert (reach * Rabs (of_x v w) <= reach * (1.001 * (f * h + h * f) + 3 * eta))
      by (apply Rmult_le_compat_l; lra).
    set (sz := Rabs (of_1 v w) + reach * Rabs (of_y v w) + reach * Rabs (of_x v w)) in *.
    assert (Hs : sz <= 1.001 * (4 * reach * (f * h) + 2 * (f * f)) + 9 * (reach * eta)) by (unfold sz; lra).
    assert (u * sz <= u * (1.001 * (4 * reach * (f * h) + 2 * (f * f)) + 9 * (reach * eta)))
      by (apply Rmult_le_compat_l; lra).
    assert (u * (reach * eta) <= 1 * (reach * eta)) by (apply Rmult_le_compat_r; lra).
    unfold Y, slack. lra.
Qed.

Lemma T_sign : Rabs (amount - s * T) <= t_max /\ s * T > 0 /\ 1/2 * tiny <= t_max.
Proof.
  assert (H := volume_bound place weight reach a b c a' b' c' ok). fold far high t_max T in H.
  assert (P := sure_volume place weight reach a b c a' b' c' ok). fold far high t_max T in P.
  split; [|split; [now apply P|]].
  - unfold amount, s, sign_of in *. apply Rabs_le_inv in H. apply Rabs_le.
    destruct (Rlt_bool_spec (volume a b c) 0) as [L|L]; [rewrite (Rabs_left _ L) | rewrite (Rabs_pos_eq _ L)];
      lra.
  - destruct nonneg as [_ [_ [_ [F0 H0]]]].
    destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [_ [_ [_ [Fm [Fk [Pm Pk]]]]]]. destruct ok.
    assert (L := volume_error_low _ _ _ _ Fm Fk f_place f_weight Pm Pk pos_place pos_weight not_tiny
      place_not_tiny).
    fold far high t_max in L. fold f h in L. assert (U := u_pos).
    assert (0 <= 6 * f * (2 * (place * h) + f * weight)) by pos. assert (0 <= u * (f * f * h)) by pos. lra.
Qed.

(** What is common to both: the signed coefficients, and |T| - error. *)
Lemma signed x : is_float x -> rnd (x * s) = x * s /\ Rabs (x * s) = Rabs x.
Proof.
  intros F. assert (S : s = 1 \/ s = -1) by apply sign_cases. destruct S as [-> | ->].
  - rewrite Rmult_1_r. split; [now apply rnd_id | reflexivity].
  - replace (x * -1) with (- x) by ring. rewrite rnd_opp, Rabs_Ropp, rnd_id by easy. now split.
Qed.
Lemma three : Rabs (linear b c - e_bc) <= X + 2.001 * Y + slack /\ u * sizes b c <= 1.001 * Y + slack /\
  Rabs (linear c a - e_ca) <= X + 2.001 * Y + slack /\ u * sizes c a <= 1.001 * Y + slack /\
  Rabs (linear a b - e_ab) <= X + 2.001 * Y + slack /\ u * sizes a b <= 1.001 * Y + slack.
Proof.
  destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [Wa [Wb [Wc _]]]. assert (O := ok). destruct O.
  destruct (coefficients b c b' c'), (coefficients c a c' a'), (coefficients a b a' b'); auto.
  repeat split; auto.
Qed.
Lemma slack_tiny : 0 <= slack <= 1e-9 * tiny.
Proof.
  destruct nonneg as [_ [_ [[R0 R1] _]]]. assert (N := eta_pos). assert (Q := tiny_eta). unfold slack.
  assert (reach * eta <= 4294967296 * eta) by (apply Rmult_le_compat_r; lra).
  assert (0 <= reach * eta) by pos. lra.
Qed.
Lemma least_range : 0 < rnd (amount - t_max) <= 1.0001 * amount.
Proof.
  assert (F : is_float amount) by apply is_float_abs, rnd_float.
  assert (G : is_float t_max) by apply rnd_float.
  destruct T_sign as [_ [_ P]]. assert (B := bpow_gt_0 radix2 (-1000)). fold tiny in B. assert (U := u_small).
  assert (S := sure). assert (E := rnd_err_sum amount (- t_max) F (is_float_opp _ G)).
  change (amount + - t_max) with (amount - t_max) in E.
  rewrite (Rabs_pos_eq (amount - t_max)) in E by lra. apply Rabs_le_inv in E.
  assert (u * (amount - t_max) <= 0.0001 * (amount - t_max)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma over_least v : 0 <= v -> 0.9999 * (v / amount) <= v / rnd (amount - t_max).
Proof.
  intros H. destruct least_range as [P Q]. set (l := rnd (amount - t_max)) in *. unfold Rdiv.
  rewrite <- Rmult_assoc, (Rmult_comm 0.9999), Rmult_assoc. apply Rmult_le_compat_l; [easy|].
  assert (0 < amount) by lra. apply (Rmult_le_reg_l l); [easy|]. rewrite Rinv_r by lra.
  apply (Rmult_le_reg_r amount); [easy|].
  replace (l * (0.9999 * / amount) * amount) with (0.9999 * l) by (field; lra). lra.
Qed.
Lemma six x : is_float x -> 0 <= x -> 0.9999 * (6 * x) <= rnd (6 * x).
Proof.
  intros F P. replace (6 * x) with (4 * x + 2 * x) by ring.
  assert (H := low_sum (4 * x) (2 * x)). rewrite <- (rnd_4 x F), <- (rnd_2 x F) in H at 1.
  specialize (H (rnd_float _) (rnd_float _) ltac:(lra)). lra.
Qed.
Lemma amount_pos : 0 < amount /\ 0 <= t_max /\ 0 < e_max.
Proof.
  destruct T_sign as [_ [_ P]]. assert (B := bpow_gt_0 radix2 (-1000)). fold tiny in B. assert (S := sure).
  assert (Q := unit_low). destruct nonneg as [X0 [Y0 _]]. lra.
Qed.

End Near.
