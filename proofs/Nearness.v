(** The fourth function: how near a triangle is at a pixel, and the bound on what rounding does to it.

    See "A triangle as four linear functions of the pixel" in docs/speed.md; the code is the second half
    of `set_up` in edge_functions.py. It is asked where T is sure: |T| > error. As in EdgeFunctions.v
    all is as if there were no largest float. A quotient by |T| may exceed it, but only for corners whose
    w is some 2^-960: then NaN comes out, of which no comparison holds, so that nothing is dropped. *)
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
Ltac pos := repeat first [assumption | apply Rabs_pos | apply Rplus_le_le_0_compat | apply Rmult_le_pos | lra].

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
  assert (H : bpow radix2 10 <= bpow radix2 1021) by (apply bpow_le; lia). change (bpow radix2 10) with 1024 in H.
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
  assert (G1 : Rabs (x - p * q) <= u * P + eta) by (assert (u * Rabs (p * q) <= u * P) by (apply Rmult_le_compat_l; lra); lra).
  assert (G2 : Rabs (y - r * s) <= u * Q + eta) by (assert (u * Rabs (r * s) <= u * Q) by (apply Rmult_le_compat_l; lra); lra).
  assert (G3 : Rabs (x - y) <= 1.0001 * (P + Q) + 2 * eta).
  { unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (u * Rabs (x - y) <= u * (1.0001 * (P + Q) + 2 * eta)) by (apply Rmult_le_compat_l; lra).
  assert (u * eta <= 0.0001 * eta) by (apply Rmult_le_compat_r; lra).
  assert (0 <= u * (P + Q)). { apply Rmult_le_pos; [lra|]. generalize (Rabs_pos (p * q)) (Rabs_pos (r * s)). lra. }
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
  assert (u * y <= 0.0001 * y /\ u * x <= 0.0001 * x /\ u * a <= 0.0001 * a /\ u * eta <= 0.0001 * eta) as [Uy [Ux [Ua Ue]]]
    by (repeat split; apply Rmult_le_compat_r; lra).
  assert (0 <= u * y /\ 0 <= u * x /\ 0 <= u * a) as [Vy [Vx Va]] by (repeat split; apply Rmult_le_pos; lra).
  assert (E3 := rnd_err_sum c1 p F (rnd_float _)). set (s := rnd (c1 + p)) in *.
  assert (Q1 : Rabs p <= 1.0001 * y + eta).
  { replace p with ((p - cy * up) + cy * up) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Q2 : Rabs q <= 1.0001 * x + eta).
  { replace q with ((q - cx * right) + cx * right) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Q3 : Rabs (c1 + p) <= a + 1.0001 * y + eta) by (eapply Rle_trans; [apply Rabs_triang|]; fold a; lra).
  assert (u * Rabs (c1 + p) <= u * (a + 1.0001 * y + eta)) by (apply Rmult_le_compat_l; lra).
  assert (Q4 : Rabs s <= 1.0001 * a + 1.0003 * y + 1.1 * eta).
  { replace s with ((s - (c1 + p)) + (c1 + p)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (E4 := rnd_err_sum s q (rnd_float _) (rnd_float _)).
  assert (Q5 : Rabs (s + q) <= 1.0001 * a + 1.0003 * y + 1.0001 * x + 2.1 * eta) by (eapply Rle_trans; [apply Rabs_triang|]; lra).
  assert (u * Rabs (s + q) <= u * (1.0001 * a + 1.0003 * y + 1.0001 * x + 2.1 * eta)) by (apply Rmult_le_compat_l; lra).
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
  destruct nonneg as [X0 [Y0 _]]. destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [_ [_ [_ [Fm [Fk [Pm Pk]]]]]]. destruct ok.
  assert (H := edge_error_low _ _ _ _ _ Fm Fk f_place f_weight f_reach Pm Pk pos_place pos_weight size_reach not_tiny).
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
  assert (M := edge_moved v w v' w' up right _ _ place weight reach pos_place pos_weight Wv Ww Cv Cw in_up in_right).
  simpl in M. fold f h X d in M.
  destruct Wv as [Vx [Vy Vz]], Ww as [Wx [Wy Wz]].
  assert (U := u_small). assert (P := u_pos). assert (N := eta_pos).
  assert (Mf : span a b c <= f) by (unfold f; lra). assert (Mh : top a b c <= h) by (unfold h; lra).
  assert (B : forall x y p q, Rabs x <= p -> Rabs y <= q -> forall p' q', p <= p' -> q <= q' -> Rabs x * Rabs y <= p' * q')
    by (intros; apply product_le; lra).
  assert (D1 := difference_off (vx v) (vy w) (vy v) (vx w) (f * f) (f * f) ltac:(eapply B; eassumption) ltac:(eapply B; eassumption)).
  assert (Dy := difference_off (vz v) (vx w) (vx v) (vz w) (h * f) (f * h) ltac:(eapply B; eassumption) ltac:(eapply B; eassumption)).
  assert (Dx := difference_off (vy v) (vz w) (vz v) (vy w) (f * h) (h * f) ltac:(eapply B; eassumption) ltac:(eapply B; eassumption)).
  fold (of_1 v w) in D1. fold (of_y v w) in Dy. fold (of_x v w) in Dx.
  assert (Sz : forall x y X Y, Rabs x <= X -> Rabs y <= Y -> Rabs (x - y) <= X + Y).
  { intros x y A B' HA HB. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (Z1 : Rabs (vx v * vy w - vy v * vx w) <= f * f + f * f) by (apply Sz; rewrite Rabs_mult; eapply B; eassumption).
  assert (Zy : Rabs (vz v * vx w - vx v * vz w) <= h * f + f * h) by (apply Sz; rewrite Rabs_mult; eapply B; eassumption).
  assert (Zx : Rabs (vy v * vz w - vz v * vy w) <= f * h + h * f) by (apply Sz; rewrite Rabs_mult; eapply B; eassumption).
  set (q1 := vx v * vy w - vy v * vx w) in *. set (qy := vz v * vx w - vx v * vz w) in *. set (qx := vy v * vz w - vz v * vy w) in *.
  assert (Re : eta <= reach * eta) by (rewrite <- (Rmult_1_l eta) at 1; apply Rmult_le_compat_r; lra).
  assert (Ff : 0 <= f * f) by pos. assert (Fh : 0 <= f * h) by pos.
  split.
  - assert (Py := product_le _ _ _ _ Dy in_up). assert (Px := product_le _ _ _ _ Dx in_right).
    rewrite <- Rabs_mult in Py, Px.
    assert (Q : linear v w - det v w d = (of_1 v w - q1) + (of_y v w - qy) * up + (of_x v w - qx) * right)
      by (unfold linear, q1, qy, qx, det, dot, cross, d, pixel_ray; simpl; ring).
    apply Rabs_le_inv in D1, Py, Px, M. apply Rabs_le. unfold Y, slack. lra.
  - unfold sizes.
    assert (K : forall c q r, Rabs (c - q) <= 2.001 * (u * r) + 3 * eta -> Rabs q <= r -> Rabs c <= 1.001 * r + 3 * eta).
    { intros k q r H1 H2. replace k with ((k - q) + q) by ring. eapply Rle_trans; [apply Rabs_triang|].
      assert (u * r <= 0.0001 * r) by (apply Rmult_le_compat_r; [generalize (Rabs_pos q); lra | lra]).
      generalize (Rabs_pos q). lra. }
    assert (K1 := K _ _ _ D1 Z1). assert (Ky := K _ _ _ Dy Zy). assert (Kx := K _ _ _ Dx Zx).
    assert (reach * Rabs (of_y v w) <= reach * (1.001 * (h * f + f * h) + 3 * eta)) by (apply Rmult_le_compat_l; lra).
    assert (reach * Rabs (of_x v w) <= reach * (1.001 * (f * h + h * f) + 3 * eta)) by (apply Rmult_le_compat_l; lra).
    set (sz := Rabs (of_1 v w) + reach * Rabs (of_y v w) + reach * Rabs (of_x v w)) in *.
    assert (Hs : sz <= 1.001 * (4 * reach * (f * h) + 2 * (f * f)) + 9 * (reach * eta)) by (unfold sz; lra).
    assert (u * sz <= u * (1.001 * (4 * reach * (f * h) + 2 * (f * f)) + 9 * (reach * eta))) by (apply Rmult_le_compat_l; lra).
    assert (u * (reach * eta) <= 1 * (reach * eta)) by (apply Rmult_le_compat_r; lra).
    unfold Y, slack. lra.
Qed.

Lemma T_sign : Rabs (amount - s * T) <= t_max /\ s * T > 0 /\ 1/2 * tiny <= t_max.
Proof.
  assert (H := volume_bound place weight reach a b c a' b' c' ok). fold far high t_max T in H.
  assert (P := sure_volume place weight reach a b c a' b' c' ok). fold far high t_max T in P.
  split; [|split; [now apply P|]].
  - unfold amount, s, sign_of in *. apply Rabs_le_inv in H. apply Rabs_le.
    destruct (Rlt_bool_spec (volume a b c) 0) as [L|L]; [rewrite (Rabs_left _ L) | rewrite (Rabs_pos_eq _ L)]; lra.
  - destruct nonneg as [_ [_ [_ [F0 H0]]]]. destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [_ [_ [_ [Fm [Fk [Pm Pk]]]]]]. destruct ok.
    assert (L := volume_error_low _ _ _ _ Fm Fk f_place f_weight Pm Pk pos_place pos_weight not_tiny place_not_tiny).
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
  destruct (coefficients b c b' c'), (coefficients c a c' a'), (coefficients a b a' b'); auto. repeat split; auto.
Qed.
Lemma slack_tiny : 0 <= slack <= 1e-9 * tiny.
Proof.
  destruct nonneg as [_ [_ [[R0 R1] _]]]. assert (N := eta_pos). assert (Q := tiny_eta). unfold slack.
  assert (reach * eta <= 4294967296 * eta) by (apply Rmult_le_compat_r; lra).
  assert (0 <= reach * eta) by pos. lra.
Qed.
Lemma least_range : 0 < rnd (amount - t_max) <= 1.0001 * amount.
Proof.
  assert (F : is_float amount) by apply is_float_abs, rnd_float. assert (G : is_float t_max) by apply rnd_float.
  destruct T_sign as [_ [_ P]]. assert (B := bpow_gt_0 radix2 (-1000)). fold tiny in B. assert (U := u_small).
  assert (S := sure). assert (E := rnd_err_sum amount (- t_max) F (is_float_opp _ G)). change (amount + - t_max) with (amount - t_max) in E.
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

(** ** Perspective *)

Definition coefficient (of : vec -> vec -> R) : R :=
  summed amount (rnd (of b c * s)) (rnd (of c a * s)) (rnd (of a b * s)).
Definition near_perspective : R := at_pixel (coefficient of_1) (coefficient of_y) (coefficient of_x) up right.

Lemma summed_off f0 f1 f2 : is_float f0 -> is_float f1 -> is_float f2 ->
  Rabs (summed amount f0 f1 f2 * amount - (f0 + f1 + f2))
  <= 3.001 * (u * (Rabs f0 + Rabs f1 + Rabs f2)) + eta * amount.
Proof.
  intros F0 F1 F2. assert (U := u_small). assert (P := u_pos). destruct amount_pos as [A0 _]. unfold summed.
  assert (E1 := rnd_err_sum _ _ F0 F1). set (x := rnd (f0 + f1)) in *.
  assert (E2 := rnd_err_sum x f2 (rnd_float _) F2). set (y := rnd (x + f2)) in *.
  assert (E3 := rnd_err (y / amount)). set (z := rnd (y / amount)) in *.
  assert (Q : Rabs (z * amount - y) <= u * Rabs y + eta * amount).
  { replace (z * amount - y) with ((z - y / amount) * amount) by (field; lra).
    rewrite Rabs_mult, (Rabs_pos_eq amount) by lra.
    assert (Rabs (z - y / amount) * amount <= (u * Rabs (y / amount) + eta) * amount) by (apply Rmult_le_compat_r; lra).
    unfold Rdiv in H. rewrite (Rabs_mult y), (Rabs_pos_eq (/ amount)) in H by (apply Rlt_le, Rinv_0_lt_compat; lra).
    replace ((u * (Rabs y * / amount) + eta) * amount) with (u * Rabs y + eta * amount) in H by (field; lra). easy. }
  set (S := Rabs f0 + Rabs f1 + Rabs f2). assert (S0 : 0 <= S) by (unfold S; pos).
  assert (US : 0 <= u * S <= 0.0001 * S) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
  assert (T1 := Rabs_triang f0 f1). assert (G : Rabs f2 <= S) by (unfold S; generalize (Rabs_pos f0) (Rabs_pos f1); lra).
  assert (B1 : Rabs (f0 + f1) + Rabs f2 <= S) by (unfold S; lra). assert (B0 := Rabs_pos f2).
  assert (u * Rabs (f0 + f1) <= u * S) by (apply Rmult_le_compat_l; lra).
  assert (B2 : Rabs (x + f2) <= 1.0001 * S).
  { replace (x + f2) with ((x - (f0 + f1)) + (f0 + f1) + f2) by ring. eapply Rle_trans; [apply Rabs_triang|].
    assert (Z := Rabs_triang (x - (f0 + f1)) (f0 + f1)). lra. }
  assert (u * Rabs (x + f2) <= u * (1.0001 * S)) by (apply Rmult_le_compat_l; lra).
  assert (B3 : Rabs y <= 1.0003 * S).
  { replace y with ((y - (x + f2)) + (x + f2)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (u * Rabs y <= u * (1.0003 * S)) by (apply Rmult_le_compat_l; lra).
  apply Rabs_le_inv in E1, E2, Q. apply Rabs_le. lra.
Qed.

Lemma near_perspective_off : Rabs (near_perspective * amount - s * (e_bc + e_ca + e_ab))
  <= 3.01 * e_max + 8 * (reach * eta) * amount.
Proof.
  destruct three as [L1 [S1 [L2 [S2 [L3 S3]]]]]. destruct slack_tiny as [K0 K1].
  destruct amount_pos as [A0 _]. destruct nonneg as [X0 [Y0 [R1 _]]]. assert (Q := unit_low).
  assert (U := u_small). assert (P := u_pos). assert (N := eta_pos).
  assert (O : forall of, (forall v w, is_float (of v w)) -> Rabs (coefficient of * amount - s * (of b c + of c a + of a b))
    <= 3.001 * (u * (Rabs (of b c) + Rabs (of c a) + Rabs (of a b))) + eta * amount).
  { intros of F. unfold coefficient. destruct (signed _ (F b c)) as [-> B1], (signed _ (F c a)) as [-> B2], (signed _ (F a b)) as [-> B3].
    assert (H := summed_off (of b c * s) (of c a * s) (of a b * s)). rewrite B1, B2, B3 in H.
    replace (s * (of b c + of c a + of a b)) with (of b c * s + of c a * s + of a b * s) by ring.
    apply H; [destruct (signed _ (F b c)) as [<- _] | destruct (signed _ (F c a)) as [<- _] | destruct (signed _ (F a b)) as [<- _]]; apply rnd_float. }
  assert (O1 := O of_1 ltac:(intros; apply rnd_float)). assert (Oy := O of_y ltac:(intros; apply rnd_float)).
  assert (Ox := O of_x ltac:(intros; apply rnd_float)). clear O.
  assert (AP := at_pixel_off (coefficient of_1) (coefficient of_y) (coefficient of_x) up right reach (rnd_float _) in_up in_right).
  fold near_perspective in AP.
  set (n1 := coefficient of_1) in *. set (ny := coefficient of_y) in *. set (nx := coefficient of_x) in *.
  set (s1 := Rabs (of_1 b c) + Rabs (of_1 c a) + Rabs (of_1 a b)) in *.
  set (sy := Rabs (of_y b c) + Rabs (of_y c a) + Rabs (of_y a b)) in *.
  set (sx := Rabs (of_x b c) + Rabs (of_x c a) + Rabs (of_x a b)) in *.
  assert (SG : u * (s1 + reach * sy + reach * sx) <= 3.003 * Y + 3 * slack) by (unfold sizes in *; unfold s1, sy, sx; lra).
  assert (s1p : 0 <= s1) by (unfold s1; pos). assert (syp : 0 <= sy) by (unfold sy; pos). assert (sxp : 0 <= sx) by (unfold sx; pos).
  assert (ry : 0 <= reach * sy) by pos. assert (rx : 0 <= reach * sx) by pos.
  (* the coefficients' own size *)
  assert (Z : forall n g t, Rabs (n * amount - s * g) <= 3.001 * (u * t) + eta * amount -> Rabs g <= t ->
    Rabs n * amount <= 1.0001 * t + eta * amount).
  { intros n g t H G. rewrite <- (Rabs_pos_eq amount) at 1 by lra. rewrite <- Rabs_mult.
    replace (n * amount) with ((n * amount - s * g) + s * g) by ring. eapply Rle_trans; [apply Rabs_triang|].
    assert (Rabs (s * g) = Rabs g).
    { rewrite Rabs_mult. replace (Rabs s) with 1; [ring|]. destruct (sign_cases (volume a b c)) as [E|E]; unfold s; rewrite E;
        unfold Rabs; destruct Rcase_abs; lra. }
    assert (u * t <= 0.00001 * t) by (apply Rmult_le_compat_r; [generalize (Rabs_pos g); lra | lra]).
    generalize (Rabs_pos g). lra. }
  assert (Tr : forall x y z, Rabs (x + y + z) <= Rabs x + Rabs y + Rabs z).
  { intros. eapply Rle_trans; [apply Rabs_triang|]. generalize (Rabs_triang x y). lra. }
  assert (Z1 := Z _ _ _ O1 (Tr _ _ _)). assert (Zy := Z _ _ _ Oy (Tr _ _ _)). assert (Zx := Z _ _ _ Ox (Tr _ _ _)).
  (* the whole *)
  assert (G1 := product_le _ _ _ _ Oy in_up). assert (G2 := product_le _ _ _ _ Ox in_right).
  rewrite <- Rabs_mult in G1, G2.
  assert (G3 : Rabs ((near_perspective - (n1 + ny * up + nx * right)) * amount)
    <= 3.001 * (u * (1.0001 * (s1 + reach * sy + reach * sx) + (1 + 2 * reach) * (eta * amount))) + 3 * eta * amount).
  { rewrite Rabs_mult, (Rabs_pos_eq amount) by lra. eapply Rle_trans; [apply Rmult_le_compat_r; [lra | exact AP]|].
    assert (reach * (Rabs ny * amount) <= reach * (1.0001 * sy + eta * amount)) by (apply Rmult_le_compat_l; lra).
    assert (reach * (Rabs nx * amount) <= reach * (1.0001 * sx + eta * amount)) by (apply Rmult_le_compat_l; lra).
    assert (u * (Rabs n1 * amount + reach * (Rabs ny * amount) + reach * (Rabs nx * amount))
      <= u * (1.0001 * s1 + eta * amount + reach * (1.0001 * sy + eta * amount) + reach * (1.0001 * sx + eta * amount)))
      by (apply Rmult_le_compat_l; lra). lra. }
  assert (EA : 0 <= eta * amount) by pos. assert (0 <= u * (s1 + reach * sy + reach * sx)) by (apply Rmult_le_pos; lra).
  assert (ER : eta * amount <= reach * (eta * amount)) by (rewrite <- (Rmult_1_l (eta * amount)) at 1; apply Rmult_le_compat_r; lra).
  assert (u * (reach * (eta * amount)) <= 0.00001 * (reach * (eta * amount))) by (apply Rmult_le_compat_r; [pos | lra]).
  assert (0 <= u * (eta * amount) <= 0.00001 * (eta * amount)) by (split; [pos | apply Rmult_le_compat_r; lra]).
  assert (ID : near_perspective * amount - s * (linear b c + linear c a + linear a b)
    = (near_perspective - (n1 + ny * up + nx * right)) * amount + (n1 * amount - s * (of_1 b c + of_1 c a + of_1 a b))
      + (ny * amount - s * (of_y b c + of_y c a + of_y a b)) * up + (nx * amount - s * (of_x b c + of_x c a + of_x a b)) * right)
    by (unfold linear; ring).
  assert (W : Rabs (near_perspective * amount - s * (linear b c + linear c a + linear a b))
    <= 6.003 * (u * (s1 + reach * sy + reach * sx)) + 8 * (reach * eta) * amount).
  { rewrite ID. eapply Rle_trans; [apply Rabs_triang|]. assert (V := Tr ((near_perspective - (n1 + ny * up + nx * right)) * amount)
      (n1 * amount - s * (of_1 b c + of_1 c a + of_1 a b)) ((ny * amount - s * (of_y b c + of_y c a + of_y a b)) * up)). lra. }
  assert (M : Rabs (s * (linear b c + linear c a + linear a b) - s * (e_bc + e_ca + e_ab)) <= 3 * (X + 2.001 * Y + slack)).
  { apply Rabs_le_inv in L1, L2, L3. apply Rabs_le. destruct (sign_cases (volume a b c)) as [E|E]; unfold s; rewrite E; lra. }
  replace (near_perspective * amount - s * (e_bc + e_ca + e_ab))
    with ((near_perspective * amount - s * (linear b c + linear c a + linear a b))
      + (s * (linear b c + linear c a + linear a b) - s * (e_bc + e_ca + e_ab))) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.

(** 1 / t of the stored ray, where it is beyond the clip start; so it is at most [nearest]. What
    Film.v has to say: it is the quotient of the determinants, but for [rho], which is half of what
    the code counts, 2 ray_error; or all of it, where that is small. *)
Variables ray_error nearest inverse rho : R.
Hypothesis f_ray : is_float ray_error. Hypothesis pos_ray : 0 <= ray_error.
Hypothesis nearest_not_tiny : bpow radix2 (-960) <= nearest.
Hypothesis seen : 0 < inverse <= nearest.
Hypothesis ray_off : Rabs ((e_bc + e_ca + e_ab) / T - inverse) <= rho * nearest.
Hypothesis rho_fits : 0 <= rho <= 2 * ray_error /\ (2 * rho <= 2 * ray_error \/ rho <= 1 / 128).

Theorem perspective_nearness :
  let error := perspective_error e_max t_max amount ray_error nearest in
  rnd (near_perspective - error) <= inverse <= Rmin (rnd (near_perspective + error)) nearest.
Proof.
  intros error. assert (O := near_perspective_off). destruct T_sign as [AT [PT _]].
  destruct amount_pos as [A0 [Tp Ep]]. destruct nonneg as [_ [_ [R1 _]]].
  assert (U := u_small). assert (P := u_pos). assert (N := eta_pos). assert (M := more_value). assert (Sr := sure).
  set (n := near_perspective) in *. set (S := e_bc + e_ca + e_ab) in *.
  assert (Tn : T <> 0) by (intros Z; rewrite Z in PT; lra).
  set (x := t_max / amount). set (ea := e_max / amount).
  assert (Ia : 0 < / amount) by (apply Rinv_0_lt_compat; lra).
  assert (x0 : 0 <= x) by (apply Rmult_le_pos; lra). assert (ea0 : 0 <= ea) by (apply Rmult_le_pos; lra).
  assert (x1 : x <= 1). { apply (Rmult_le_reg_r amount); [easy|]. unfold x. replace (t_max / amount * amount) with t_max by (field; lra). lra. }
  assert (nn : 0 < nearest) by lra.
  set (q := S / T) in *.
  assert (Q1 : Rabs (n - q) <= 3.01 * ea + 8 * (reach * eta) + Rabs q * x).
  { apply (Rmult_le_reg_r amount); [easy|]. rewrite <- (Rabs_pos_eq amount) at 1 by lra. rewrite <- Rabs_mult.
    replace ((n - q) * amount) with ((n * amount - s * S) + - (q * (amount - s * T))) by (unfold q; field; exact Tn).
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, (Rabs_mult q).
    assert (Rabs q * Rabs (amount - s * T) <= Rabs q * t_max) by (apply Rmult_le_compat_l; [apply Rabs_pos | easy]).
    replace ((3.01 * ea + 8 * (reach * eta) + Rabs q * x) * amount)
      with (3.01 * e_max + 8 * (reach * eta) * amount + Rabs q * t_max) by (unfold ea, x; field; lra). lra. }
  assert (Q2 : Rabs q <= nearest + rho * nearest).
  { replace q with ((q - inverse) + inverse) by ring. eapply Rle_trans; [apply Rabs_triang|].
    rewrite (Rabs_pos_eq inverse) by lra. lra. }
  assert (Q3 : Rabs q * x <= (nearest + rho * nearest) * x) by (apply Rmult_le_compat_r; lra).
  destruct rho_fits as [[r0 r1] r2].
  assert (rn : 0 <= rho * nearest <= 2 * ray_error * nearest) by (split; [pos | apply Rmult_le_compat_r; lra]).
  assert (xn : 0 <= x * nearest) by pos.
  assert (Q4 : rho * nearest + rho * nearest * x <= 2 * ray_error * nearest + 1/128 * (x * nearest)).
  { destruct r2 as [r2|r2].
    - assert (rho * nearest * x <= rho * nearest * 1) by (apply Rmult_le_compat_l; lra).
      assert (2 * rho * nearest <= 2 * ray_error * nearest) by (apply Rmult_le_compat_r; lra). lra.
    - assert (rho * (x * nearest) <= 1/128 * (x * nearest)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (un : 0 < u * nearest <= 1e-10 * nearest) by (split; [apply Rmult_lt_0_compat; lra | apply Rmult_le_compat_r; lra]).
  assert (Et : reach * eta <= 1/1000 * (u * nearest)).
  { assert (reach * eta <= 4294967296 * eta) by (apply Rmult_le_compat_r; lra).
    assert (u * bpow radix2 (-960) <= u * nearest) by (apply Rmult_le_compat_l; lra).
    rewrite u_bpow, <- bpow_plus in H0. simpl Z.add in H0. rewrite <- u_bpow in H0.
    assert (E : eta = / 2 * bpow radix2 (-1074)) by reflexivity.
    change (-1013)%Z with (61 + -1074)%Z in H0. rewrite bpow_plus in H0. change (bpow radix2 61) with 2305843009213693952 in H0. lra. }
  assert (eta <= reach * eta) by (rewrite <- (Rmult_1_l eta) at 1; apply Rmult_le_compat_r; lra).
  assert (Off : Rabs (n - inverse) <= 3.01 * ea + 1.008 * (x * nearest) + 2 * ray_error * nearest + 1/100 * (u * nearest)).
  { replace (n - inverse) with ((n - q) + (q - inverse)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  (* the bound, from below *)
  assert (Fr : is_float (2 * ray_error)) by (rewrite <- rnd_2 by easy; apply rnd_float).
  assert (F16 : is_float (16 * u)).
  { rewrite u_bpow. change 16 with (bpow radix2 4). rewrite <- bpow_plus. apply generic_format_bpow. unfold fexp, FLT_exp, prec. lia. }
  unfold error, perspective_error. rewrite (rnd_2 _ f_ray).
  assert (c0 := low_sum _ _ Fr F16 ltac:(lra)). assert (c1 := rnd_pos (2 * ray_error + 16 * u) ltac:(lra)).
  set (cc := rnd (2 * ray_error + 16 * u)) in *.
  assert (g0 := over_least t_max Tp). fold x in g0.
  set (least := rnd (amount - t_max)) in *.
  assert (g1 := low (t_max / least) ltac:(lra)). assert (g2 := rnd_pos (t_max / least) ltac:(lra)).
  assert (h0 := low_sum (rnd (t_max / least)) cc (rnd_float _) (rnd_float _) ltac:(lra)).
  set (rel := rnd (rnd (t_max / least) + cc)) in *.
  assert (h1 : 0.999 * (x + 2 * ray_error + 16 * u) - eta <= rel) by lra.
  assert (h2 : 0 <= rel) by (apply rnd_pos; lra).
  assert (h3 : (0.999 * (x + 2 * ray_error + 16 * u) - eta) * nearest <= rel * nearest) by (apply Rmult_le_compat_r; lra).
  assert (h4 := low (rel * nearest) ltac:(pos)). assert (h5 := rnd_pos (rel * nearest) ltac:(pos)).
  assert (k0 := six e_max (rnd_float _) ltac:(lra)).
  assert (k1 := over_least (rnd (6 * e_max)) ltac:(lra)). fold least in k1.
  assert (k2 : 0.9999 * (6 * ea) <= rnd (6 * e_max) / amount).
  { unfold ea, Rdiv. assert (0.9999 * (6 * e_max) * / amount <= rnd (6 * e_max) * / amount) by (apply Rmult_le_compat_r; lra). lra. }
  assert (k3 := low (rnd (6 * e_max) / least) ltac:(lra)). assert (k4 := rnd_pos (rnd (6 * e_max) / least) ltac:(lra)).
  set (big := rnd (rnd (6 * e_max) / least)) in *.
  assert (m0 := low_sum big (rnd (rel * nearest)) (rnd_float _) (rnd_float _) ltac:(lra)).
  assert (m1 := rnd_pos (big + rnd (rel * nearest)) ltac:(lra)).
  set (sum := rnd (big + rnd (rel * nearest))) in *.
  assert (m2 : 1.00999999 * sum <= sum * more) by (rewrite Rmult_comm; apply Rmult_le_compat_l; lra).
  assert (m3 := low (sum * more) ltac:(lra)). assert (m4 := rnd_pos (sum * more) ltac:(lra)).
  set (er := rnd (sum * more)) in *.
  assert (en : eta * nearest <= 1/1000 * (u * nearest)).
  { assert (eta * nearest <= 1/1000 * u * nearest) by (apply Rmult_le_compat_r; [lra | exact eta_u]). lra. }
  assert (ry : 0 <= 2 * ray_error * nearest) by lra. assert (en0 : 0 <= eta * nearest) by (apply Rmult_le_pos; lra).
  assert (Er : 1.0081 * (6 * ea + x * nearest + 2 * ray_error * nearest + 16 * (u * nearest)) - 4 * eta - 2 * (eta * nearest) <= er) by lra.
  (* the last rounding *)
  assert (Fn : is_float n) by apply rnd_float. assert (Fe : is_float er) by apply rnd_float.
  assert (Z1 := rnd_err_sum n (- er) Fn (is_float_opp _ Fe)). change (n + - er) with (n - er) in Z1.
  assert (Z2 := rnd_err_sum n er Fn Fe).
  assert (Nn : Rabs n <= nearest + er).
  { replace n with ((n - inverse) + inverse) by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_pos_eq inverse) by lra. lra. }
  assert (ue : u * er <= 1e-10 * er) by (apply Rmult_le_compat_r; lra).
  assert (Y1 : u * Rabs (n - er) <= u * (nearest + 2 * er)).
  { apply Rmult_le_compat_l; [lra|]. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, (Rabs_pos_eq er); lra. }
  assert (Y2 : u * Rabs (n + er) <= u * (nearest + 2 * er)).
  { apply Rmult_le_compat_l; [lra|]. eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_pos_eq er); lra. }
  apply Rabs_le_inv in Z1, Z2, Off. split; [lra|]. apply Rmin_glb; lra.
Qed.

(** ** Parallel rays *)

(** The depths of the corners as computed, and exactly; [own] bounds how far they are apart, is larger
    than a few roundings of them, and not tiny. All w are 1, so the three e sum up to T. The stored
    ray's t is the mean of the exact depths, with the weights e / T. *)
Variables da db dc own da' db' dc' : R.
Hypothesis f_da : is_float da. Hypothesis f_db : is_float db. Hypothesis f_dc : is_float dc.
Hypothesis f_own : is_float own.
Hypothesis own_a : Rabs (da - da') <= own. Hypothesis own_b : Rabs (db - db') <= own.
Hypothesis own_c : Rabs (dc - dc') <= own.
Hypothesis rounds_a : 16 * u * Rabs da <= own. Hypothesis rounds_b : 16 * u * Rabs db <= own.
Hypothesis rounds_c : 16 * u * Rabs dc <= own.
Hypothesis own_not_tiny : bpow radix2 (-900) <= own.
Hypothesis w_is_1 : vz a = 1 /\ vz a' = 1 /\ vz b' = 1 /\ vz c' = 1.

Let bb := rnd (db - da).
Let cc := rnd (dc - da).
Definition coefficient_p (of : vec -> vec -> R) : R :=
  mixed amount (rnd (of c a * s)) (rnd (of a b * s)) bb cc.
Definition near_parallel : R :=
  at_pixel (rnd (coefficient_p of_1 - da)) (coefficient_p of_y) (coefficient_p of_x) up right.
Let B := Rmax (Rabs bb) (Rabs cc).

Lemma amount_not_tiny : bpow radix2 (-120) <= amount.
Proof.
  destruct nonneg as [_ [_ [_ [F0 H0]]]]. destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [[_ [_ Wz]] [_ [_ [Fm [Fk [Pm Pk]]]]]].
  assert (S := sure). destruct ok. destruct w_is_1 as [W _]. rewrite W, Rabs_R1 in Wz.
  assert (L := volume_error_low _ _ _ _ Fm Fk f_place f_weight Pm Pk pos_place pos_weight not_tiny place_not_tiny).
  fold far high t_max in L. fold f h in L. assert (U := u_pos).
  assert (Bt := bpow_gt_0 radix2 (-1000)). fold tiny in Bt.
  assert (h1 : 1 <= h) by (unfold h; lra).
  assert (p : bpow radix2 (-60) <= place).
  { apply (Rmult_le_reg_l (bpow radix2 60)); [apply bpow_gt_0|]. rewrite <- bpow_plus. change (bpow radix2 (60 + -60)) with 1. fold h in place_not_tiny. lra. }
  assert (0 <= u * (f * f * h)) by pos. assert (0 <= f * (f * weight)) by pos.
  assert (Q : bpow radix2 (-60) * bpow radix2 (-60) <= f * place).
  { apply Rmult_le_compat; try apply bpow_ge_0; try easy. unfold f; lra. }
  rewrite <- bpow_plus in Q. simpl Z.add in Q.
  assert (f * place * 1 <= f * place * h) by (apply Rmult_le_compat_l; [pos | easy]).
  generalize (bpow_gt_0 radix2 (-120)). lra.
Qed.

Lemma B_facts : Rabs bb <= B /\ Rabs cc <= B /\ 0 <= B /\ u * B <= 0.126 * own /\
  Rabs (bb - (db - da)) <= own / 8 /\ Rabs (cc - (dc - da)) <= own / 8 /\ 0 < own.
Proof.
  assert (U := u_small). assert (P := u_pos). assert (O := bpow_gt_0 radix2 (-900)).
  assert (M1 : Rabs bb <= B) by apply Rmax_l. assert (M2 : Rabs cc <= B) by apply Rmax_r.
  assert (K : forall x, is_float x -> 16 * u * Rabs x <= own ->
    Rabs (rnd (x - da) - (x - da)) <= own / 8 /\ u * Rabs (rnd (x - da)) <= 0.126 * own).
  { intros x F R. assert (E := rnd_err_sum x (- da) F (is_float_opp _ f_da)). change (x + - da) with (x - da) in E.
    assert (T1 : Rabs (x - da) <= Rabs x + Rabs da).
    { unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
    assert (T2 : u * Rabs (x - da) <= u * (Rabs x + Rabs da)) by (apply Rmult_le_compat_l; lra).
    split; [lra|].
    assert (T3 : Rabs (rnd (x - da)) <= (1 + u) * Rabs (x - da)).
    { replace (rnd (x - da)) with ((rnd (x - da) - (x - da)) + (x - da)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
    assert (T4 : u * Rabs (rnd (x - da)) <= u * ((1 + u) * Rabs (x - da))) by (apply Rmult_le_compat_l; lra).
    assert (u * (u * Rabs (x - da)) <= 0.0001 * (u * Rabs (x - da))) by (apply Rmult_le_compat_r; [|lra]; apply Rmult_le_pos; [lra | apply Rabs_pos]).
    lra. }
  destruct (K db f_db rounds_b) as [K1 K2]. destruct (K dc f_dc rounds_c) as [K3 K4].
  repeat split; auto; [eapply Rle_trans; [apply Rabs_pos | apply M1] | | lra].
  unfold B. apply Rmax_case; assumption.
Qed.

Lemma mixed_off f1 f2 : Rabs (mixed amount f1 f2 bb cc * amount + (f1 * bb + f2 * cc))
  <= 3.001 * (u * ((Rabs f1 + Rabs f2) * B)) + 3 * eta + eta * amount.
Proof.
  assert (U := u_small). assert (P := u_pos). assert (N := eta_pos). destruct amount_pos as [A0 _].
  destruct B_facts as [Bb [Bc [B0 _]]]. unfold mixed.
  assert (E1 := rnd_err (f1 * bb)). assert (E2 := rnd_err (f2 * cc)).
  set (x := rnd (f1 * bb)) in *. set (y := rnd (f2 * cc)) in *.
  assert (E3 := rnd_err_sum x y (rnd_float _) (rnd_float _)). set (z := rnd (x + y)) in *.
  assert (E4 := rnd_err (z / - amount)). set (w := rnd (z / - amount)) in *.
  assert (Q : Rabs (w * amount + z) <= u * Rabs z + eta * amount).
  { replace (w * amount + z) with ((w - z / - amount) * amount) by (field; lra).
    rewrite Rabs_mult, (Rabs_pos_eq amount) by lra.
    assert (H : Rabs (w - z / - amount) * amount <= (u * Rabs (z / - amount) + eta) * amount) by (apply Rmult_le_compat_r; lra).
    replace (Rabs (z / - amount)) with (Rabs z / amount) in H.
    2: { unfold Rdiv. rewrite Rabs_mult, Rinv_opp, Rabs_Ropp, (Rabs_pos_eq (/ amount)) by (try lra; apply Rlt_le, Rinv_0_lt_compat; lra). easy. }
    replace ((u * (Rabs z / amount) + eta) * amount) with (u * Rabs z + eta * amount) in H by (field; lra). easy. }
  set (S := (Rabs f1 + Rabs f2) * B).
  assert (P1 : Rabs (f1 * bb) <= Rabs f1 * B) by (rewrite Rabs_mult; apply Rmult_le_compat_l; [apply Rabs_pos | easy]).
  assert (P2 : Rabs (f2 * cc) <= Rabs f2 * B) by (rewrite Rabs_mult; apply Rmult_le_compat_l; [apply Rabs_pos | easy]).
  assert (PS : Rabs (f1 * bb) + Rabs (f2 * cc) <= S) by (unfold S; lra).
  assert (S0 : 0 <= S) by (generalize (Rabs_pos (f1 * bb)) (Rabs_pos (f2 * cc)); lra).
  assert (US : 0 <= u * S <= 0.0001 * S) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
  assert (Ue : 0 <= u * eta <= 0.0001 * eta) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
  assert (UP : u * (Rabs (f1 * bb) + Rabs (f2 * cc)) <= u * S) by (apply Rmult_le_compat_l; lra).
  assert (B2 : Rabs (x + y) <= 1.0001 * S + 2 * eta).
  { replace (x + y) with ((x - f1 * bb) + (y - f2 * cc) + (f1 * bb + f2 * cc)) by ring. eapply Rle_trans; [apply Rabs_triang|].
    generalize (Rabs_triang (x - f1 * bb) (y - f2 * cc)) (Rabs_triang (f1 * bb) (f2 * cc)). lra. }
  assert (UB : u * Rabs (x + y) <= u * (1.0001 * S + 2 * eta)) by (apply Rmult_le_compat_l; lra).
  assert (B3 : Rabs z <= 1.0003 * S + 3 * eta).
  { replace z with ((z - (x + y)) + (x + y)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (UZ : u * Rabs z <= u * (1.0003 * S + 3 * eta)) by (apply Rmult_le_compat_l; lra).
  apply Rabs_le_inv in E1, E2, E3, Q. apply Rabs_le. lra.
Qed.

Lemma near_parallel_off :
  Rabs ((near_parallel + da) * amount + s * (linear c a * bb + linear a b * cc))
  <= 7.01 * ((2.002 * Y + 2 * slack) * B) + 4.01 * (u * Rabs da) * amount + 10 * (reach * eta) + 8 * (reach * eta) * amount.
Proof.
  destruct three as [_ [_ [_ [S2 [_ S3]]]]]. destruct slack_tiny as [K0 K1].
  destruct amount_pos as [A0 _]. destruct nonneg as [_ [Y0 [R1 _]]].
  assert (U := u_small). assert (P := u_pos). assert (N := eta_pos). destruct B_facts as [_ [_ [B0 _]]].
  assert (O : forall of, (forall v w, is_float (of v w)) -> Rabs (coefficient_p of * amount + s * (of c a * bb + of a b * cc))
    <= 3.001 * (u * ((Rabs (of c a) + Rabs (of a b)) * B)) + 3 * eta + eta * amount /\
    Rabs (coefficient_p of) * amount <= 1.0001 * ((Rabs (of c a) + Rabs (of a b)) * B) + 3 * eta + eta * amount).
  { intros of F. unfold coefficient_p. destruct (signed _ (F c a)) as [-> B2], (signed _ (F a b)) as [-> B3].
    assert (H := mixed_off (of c a * s) (of a b * s)). rewrite B2, B3 in H.
    set (g := mixed amount (of c a * s) (of a b * s) bb cc) in *. set (S := (Rabs (of c a) + Rabs (of a b)) * B) in *.
    assert (S0 : 0 <= S) by (unfold S; pos).
    replace (of c a * s * bb + of a b * s * cc) with (s * (of c a * bb + of a b * cc)) in H by ring. split; [easy|].
    destruct B_facts as [Bb [Bc _]].
    assert (Q : Rabs (s * (of c a * bb + of a b * cc)) <= S).
    { replace (s * (of c a * bb + of a b * cc)) with (of c a * s * bb + of a b * s * cc) by ring.
      eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_mult _ bb), (Rabs_mult _ cc), B2, B3.
      assert (Rabs (of c a) * Rabs bb <= Rabs (of c a) * B) by (apply Rmult_le_compat_l; [apply Rabs_pos | easy]).
      assert (Rabs (of a b) * Rabs cc <= Rabs (of a b) * B) by (apply Rmult_le_compat_l; [apply Rabs_pos | easy]). unfold S. lra. }
    assert (u * S <= 0.00001 * S) by (apply Rmult_le_compat_r; lra).
    rewrite <- (Rabs_pos_eq amount) at 1 by lra. rewrite <- Rabs_mult. set (m := s * (of c a * bb + of a b * cc)) in *.
    replace (g * amount) with ((g * amount + m) + - m) by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  destruct (O of_1 ltac:(intros; apply rnd_float)) as [O1 Z1]. destruct (O of_y ltac:(intros; apply rnd_float)) as [Oy Zy].
  destruct (O of_x ltac:(intros; apply rnd_float)) as [Ox Zx]. clear O.
  assert (AP := at_pixel_off (rnd (coefficient_p of_1 - da)) (coefficient_p of_y) (coefficient_p of_x) up right reach (rnd_float _) in_up in_right).
  fold near_parallel in AP.
  assert (E0 := rnd_err_sum (coefficient_p of_1) (- da) (rnd_float _) (is_float_opp _ f_da)).
  change (coefficient_p of_1 + - da) with (coefficient_p of_1 - da) in E0.
  set (n1 := coefficient_p of_1) in *. set (ny := coefficient_p of_y) in *. set (nx := coefficient_p of_x) in *.
  set (s1 := (Rabs (of_1 c a) + Rabs (of_1 a b)) * B) in *.
  set (sy := (Rabs (of_y c a) + Rabs (of_y a b)) * B) in *.
  set (sx := (Rabs (of_x c a) + Rabs (of_x a b)) * B) in *.
  assert (SG : u * (s1 + reach * sy + reach * sx) <= (2.002 * Y + 2 * slack) * B).
  { replace (u * (s1 + reach * sy + reach * sx)) with ((u * sizes c a + u * sizes a b) * B) by (unfold sizes, s1, sy, sx; ring).
    apply Rmult_le_compat_r; lra. }
  assert (s1p : 0 <= s1) by (unfold s1; pos). assert (syp : 0 <= sy) by (unfold sy; pos). assert (sxp : 0 <= sx) by (unfold sx; pos).
  assert (ry : 0 <= reach * sy) by pos. assert (rx : 0 <= reach * sx) by pos.
  assert (SG0 : 0 <= u * (s1 + reach * sy + reach * sx)) by (apply Rmult_le_pos; lra).
  assert (D0 : Rabs (n1 - da) <= Rabs n1 + Rabs da) by (unfold Rminus; eapply Rle_trans; [apply Rabs_triang|]; rewrite Rabs_Ropp; lra).
  assert (D1 : u * Rabs (n1 - da) <= u * (Rabs n1 + Rabs da)) by (apply Rmult_le_compat_l; lra).
  set (g1 := rnd (n1 - da)) in *.
  assert (D2 : Rabs g1 <= 1.0001 * (Rabs n1 + Rabs da)).
  { replace g1 with ((g1 - (n1 - da)) + (n1 - da)) by ring. eapply Rle_trans; [apply Rabs_triang|].
    assert (u * (Rabs n1 + Rabs da) <= 0.0001 * (Rabs n1 + Rabs da)) by (apply Rmult_le_compat_r; [pos | lra]). lra. }
  set (t := Rabs n1 + reach * Rabs ny + reach * Rabs nx).
  assert (AP2 : Rabs (near_parallel - (n1 - da + ny * up + nx * right)) <= 4.002 * (u * t) + 4.002 * (u * Rabs da) + 3 * eta).
  { assert (u * (Rabs g1 + reach * Rabs ny + reach * Rabs nx) <= u * (1.0001 * (Rabs n1 + Rabs da) + reach * Rabs ny + reach * Rabs nx))
      by (apply Rmult_le_compat_l; lra).
    assert (0 <= u * (reach * Rabs ny)) by (repeat (apply Rmult_le_pos; [lra|]); apply Rabs_pos).
    assert (0 <= u * (reach * Rabs nx)) by (repeat (apply Rmult_le_pos; [lra|]); apply Rabs_pos).
    assert (0 <= u * Rabs n1 /\ 0 <= u * Rabs da) by (split; apply Rmult_le_pos; try lra; apply Rabs_pos).
    replace (near_parallel - (n1 - da + ny * up + nx * right)) with ((near_parallel - (g1 + ny * up + nx * right)) + (g1 - (n1 - da))) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. unfold t. lra. }
  assert (EA : 0 <= eta * amount) by pos.
  assert (ER : eta * amount <= reach * (eta * amount)) by (rewrite <- (Rmult_1_l (eta * amount)) at 1; apply Rmult_le_compat_r; lra).
  assert (EE : eta <= reach * eta) by (rewrite <- (Rmult_1_l eta) at 1; apply Rmult_le_compat_r; lra).
  assert (Tm : t * amount <= 1.0001 * (s1 + reach * sy + reach * sx) + 9 * (reach * eta) + 3 * (reach * (eta * amount))).
  { assert (reach * (Rabs ny * amount) <= reach * (1.0001 * sy + 3 * eta + eta * amount)) by (apply Rmult_le_compat_l; lra).
    assert (reach * (Rabs nx * amount) <= reach * (1.0001 * sx + 3 * eta + eta * amount)) by (apply Rmult_le_compat_l; lra).
    unfold t. lra. }
  assert (UT : u * (t * amount) <= u * (1.0001 * (s1 + reach * sy + reach * sx) + 9 * (reach * eta) + 3 * (reach * (eta * amount))))
    by (apply Rmult_le_compat_l; lra).
  assert (0 <= u * (reach * eta) <= 0.00001 * (reach * eta)) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
  assert (0 <= u * (reach * (eta * amount)) <= 0.00001 * (reach * (eta * amount))) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
  assert (G3 : Rabs ((near_parallel - (n1 - da + ny * up + nx * right)) * amount)
    <= (4.002 * (u * t) + 4.002 * (u * Rabs da) + 3 * eta) * amount).
  { rewrite Rabs_mult, (Rabs_pos_eq amount) by lra. apply Rmult_le_compat_r; lra. }
  assert (G1 := product_le _ _ _ _ Oy in_up). assert (G2 := product_le _ _ _ _ Ox in_right). rewrite <- Rabs_mult in G1, G2.
  set (x1 := n1 * amount + s * (of_1 c a * bb + of_1 a b * cc)) in *.
  set (xy := (ny * amount + s * (of_y c a * bb + of_y a b * cc)) * up) in *.
  set (xx := (nx * amount + s * (of_x c a * bb + of_x a b * cc)) * right) in *.
  set (xp := (near_parallel - (n1 - da + ny * up + nx * right)) * amount) in *.
  replace ((near_parallel + da) * amount + s * (linear c a * bb + linear a b * cc)) with (xp + x1 + xy + xx)
    by (unfold xp, x1, xy, xx, linear; ring).
  assert (0 <= u * Rabs da * amount) by (apply Rmult_le_pos; [apply Rmult_le_pos; [lra | apply Rabs_pos] | lra]).
  assert (V1 := Rabs_triang xp x1). assert (V2 := Rabs_triang (xp + x1) xy).
  eapply Rle_trans; [apply Rabs_triang|].
  eapply Rle_trans; [apply Rplus_le_compat; [eapply Rle_trans; [exact V2|]; apply Rplus_le_compat; [eapply Rle_trans; [exact V1 | apply Rplus_le_compat; eassumption]|]|]; eassumption|].
  clear V1 V2. lra.
Qed.

Lemma reach_eta : reach * eta <= own / 1000 /\ 10 * (reach * eta) <= own / 100 * amount.
Proof.
  destruct nonneg as [_ [_ [R1 _]]]. assert (N := eta_pos). assert (A0 := amount_not_tiny).
  assert (H : reach * eta <= bpow radix2 32 * bpow radix2 (-1074)).
  { assert (E : eta = / 2 * bpow radix2 (-1074)) by reflexivity. change (bpow radix2 32) with 4294967296.
    generalize (bpow_gt_0 radix2 (-1074)). intros. apply Rmult_le_compat; lra. }
  rewrite <- bpow_plus in H. simpl Z.add in H.
  assert (L : forall n, (n <= -20)%Z -> bpow radix2 n <= / 1000000).
  { intros n Hn. assert (bpow radix2 n <= bpow radix2 (-20)) by (apply bpow_le; lia). simpl (bpow radix2 (-20)) in *. lra. }
  assert (K : bpow radix2 (-900) * bpow radix2 (-120) <= own * amount) by (apply Rmult_le_compat; try apply bpow_ge_0; easy).
  rewrite <- bpow_plus in K. simpl Z.add in K.
  assert (bpow radix2 (-1042) <= / 1000000 * bpow radix2 (-1020)).
  { change (-1042)%Z with (-22 + -1020)%Z. rewrite bpow_plus. apply Rmult_le_compat_r; [apply bpow_ge_0 | apply L; lia]. }
  assert (bpow radix2 (-1042) <= / 1000000 * bpow radix2 (-900)).
  { change (-1042)%Z with (-142 + -900)%Z. rewrite bpow_plus. apply Rmult_le_compat_r; [apply bpow_ge_0 | apply L; lia]. }
  generalize (bpow_gt_0 radix2 (-1020)) (bpow_gt_0 radix2 (-900)). lra.
Qed.

Let la := e_bc / T.
Let lb := e_ca / T.
Let lc := e_ab / T.
Let t := (e_bc * da' + e_ca * db' + e_ab * dc') / T.
Hypothesis meets : 0 <= T * e_bc /\ 0 <= T * e_ca /\ 0 <= T * e_ab.

Lemma weights : 0 <= la /\ 0 <= lb /\ 0 <= lc /\ la + lb + lc = 1 /\ T <> 0.
Proof.
  destruct T_sign as [_ [PT _]]. assert (Tn : T <> 0) by (intros Z; rewrite Z in PT; lra).
  assert (Q := fun v => quotient_sign v T Tn).
  destruct meets as [H1 [H2 H3]]. repeat split; auto; try (now apply Q).
  assert (Sum : e_bc + e_ca + e_ab = T).
  { destruct w_is_1 as [_ [Wa [Wb Wc]]]. unfold e_bc, e_ca, e_ab, T, det, dot, cross, d, pixel_ray. simpl.
    rewrite Wa, Wb, Wc. ring. }
  unfold la, lb, lc. replace (e_bc / T + e_ca / T + e_ab / T) with ((e_bc + e_ca + e_ab) / T) by (field; exact Tn).
  rewrite Sum. field. exact Tn.
Qed.

Lemma parallel_off : Rabs (near_parallel + t) <= 2.3 * ((e_max / amount + t_max / amount) * B) + 1.5 * own.
Proof.
  assert (O := near_parallel_off). destruct three as [_ [_ [L2 [_ [L3 _]]]]]. destruct T_sign as [AT [_ _]].
  destruct weights as [La [Lb [Lc [L1 Tn]]]]. destruct B_facts as [Bb [Bc [B0 [UB [Db [Dc Op]]]]]].
  destruct reach_eta as [Re Ra]. destruct amount_pos as [A0 [Tp Ep]]. destruct slack_tiny as [K0 K1].
  destruct nonneg as [X0 [Y0 _]]. assert (Q := unit_low).
  assert (W : forall e l, Rabs (l - e) <= X + 2.001 * Y + slack -> 0 <= e / T <= 1 ->
    Rabs (s * l - e / T * amount) <= X + 2.001 * Y + slack + t_max).
  { intros e l H G. replace (s * l - e / T * amount) with (s * (l - e) + - (e / T * (amount - s * T))) by (field; exact Tn).
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, (Rabs_mult (e / T)), (Rabs_pos_eq (e / T)) by lra.
    assert (e / T * Rabs (amount - s * T) <= 1 * t_max) by (apply Rmult_le_compat; try lra; apply Rabs_pos).
    assert (Rabs (s * (l - e)) = Rabs (l - e)).
    { rewrite Rabs_mult. destruct (sign_cases (volume a b c)) as [E|E]; unfold s; rewrite E; unfold Rabs at 1; destruct Rcase_abs; lra. }
    lra. }
  assert (W2 := W _ _ L2 ltac:(fold lb; lra)). assert (W3 := W _ _ L3 ltac:(fold lc; lra)). fold lb in W2. fold lc in W3.
  assert (P2 := product_le _ _ _ _ W2 Bb). assert (P3 := product_le _ _ _ _ W3 Bc). rewrite <- Rabs_mult in P2, P3.
  assert (D : Rabs (near_parallel + da + lb * bb + lc * cc)
    <= 2.3 * ((e_max / amount + t_max / amount) * B) + 4.01 * (u * Rabs da) + own / 100 + 8 * (reach * eta)).
  { apply (Rmult_le_reg_r amount); [easy|]. rewrite <- (Rabs_pos_eq amount) at 1 by lra. rewrite <- Rabs_mult.
    replace ((2.3 * ((e_max / amount + t_max / amount) * B) + 4.01 * (u * Rabs da) + own / 100 + 8 * (reach * eta)) * amount)
      with (2.3 * ((e_max + t_max) * B) + 4.01 * (u * Rabs da) * amount + own / 100 * amount + 8 * (reach * eta) * amount) by (field; lra).
    set (p2 := (s * linear c a - lb * amount) * bb) in *. set (p3 := (s * linear a b - lc * amount) * cc) in *.
    set (o := (near_parallel + da) * amount + s * (linear c a * bb + linear a b * cc)) in *.
    replace ((near_parallel + da + lb * bb + lc * cc) * amount) with (o + - p2 + - p3) by (unfold o, p2, p3; ring).
    assert (V := Rabs_triang (o + - p2) (- p3)). assert (V2 := Rabs_triang o (- p2)). rewrite Rabs_Ropp in V, V2.
    assert (M : (2 * X + 18.05 * Y + 17 * slack + 2 * t_max) * B <= 2.3 * (e_max + t_max) * B) by (apply Rmult_le_compat_r; lra).
    assert (0 <= Y * B) by (apply Rmult_le_pos; lra). assert (0 <= slack * B) by (apply Rmult_le_pos; lra). lra. }
  assert (G2 := scaled_off lb _ _ _ Lb Db). assert (G3 := scaled_off lc _ _ _ Lc Dc).
  assert (H1 := scaled_off la _ _ _ La own_a). assert (H2 := scaled_off lb _ _ _ Lb own_b).
  assert (H3 := scaled_off lc _ _ _ Lc own_c).
  assert (Et : t = la * da' + lb * db' + lc * dc') by (unfold t, la, lb, lc; field; exact Tn).
  assert (Ea : la = 1 - lb - lc) by lra. clear - Et Ea H1 H2 H3 G2 G3 D rounds_a Re Op La Lb Lc L1.
  rewrite Ea in *. apply Rabs_le_inv in D. apply Rabs_le.
  assert (lb * own + lc * own <= own) by (assert (0 <= (1 - lb - lc) * own) by (apply Rmult_le_pos; lra); lra).
  lra.
Qed.

Variable nearest_p : R.
Hypothesis seen_p : - t <= nearest_p.

(** Where the ray meets the triangle, -t is between the two that come out. *)
Theorem parallel_nearness :
  let error := parallel_error e_max t_max amount bb cc own in
  rnd (near_parallel - error) <= - t <= Rmin (rnd (near_parallel + error)) nearest_p.
Proof.
  intros error. assert (O := parallel_off). destruct B_facts as [_ [_ [B0 [UB [_ [_ Op]]]]]].
  destruct amount_pos as [A0 [Tp Ep]]. destruct reach_eta as [Re _]. destruct nonneg as [_ [_ [R1 _]]].
  destruct weights as [La [Lb [Lc [L1 Tn]]]].
  assert (U := u_small). assert (P := u_pos). assert (N := eta_pos). assert (M := more_value).
  assert (EE : eta <= reach * eta) by (rewrite <- (Rmult_1_l eta) at 1; apply Rmult_le_compat_r; lra).
  set (n := near_parallel) in *. set (ex := e_max / amount + t_max / amount) in *.
  assert (Ex : ex = (e_max + t_max) / amount) by (unfold ex; field; lra).
  assert (ex0 : 0 <= ex). { rewrite Ex. apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra]. }
  unfold error, parallel_error. fold B. rewrite (rnd_2 own), (rnd_4 own) by easy.
  assert (s0 := low_sum e_max t_max (rnd_float _) (rnd_float _) ltac:(lra)).
  set (both := rnd (e_max + t_max)) in *.
  assert (s1 := six both (rnd_float _) ltac:(lra)).
  assert (s2 := over_least (rnd (6 * both)) ltac:(lra)). set (least := rnd (amount - t_max)) in *.
  assert (s3 : 0.9997 * (6 * ex) <= rnd (6 * both) / amount).
  { rewrite Ex. unfold Rdiv. assert (0.9997 * (6 * (e_max + t_max)) * / amount <= rnd (6 * both) * / amount); [|lra].
    apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra | lra]. }
  assert (s4 := low (rnd (6 * both) / least) ltac:(lra)). assert (s5 := rnd_pos (rnd (6 * both) / least) ltac:(lra)).
  set (v := rnd (rnd (6 * both) / least)) in *.
  assert (F2 : is_float (2 * own)) by (rewrite <- rnd_2 by easy; apply rnd_float).
  assert (F4 : is_float (4 * own)) by (rewrite <- rnd_4 by easy; apply rnd_float).
  assert (FB : is_float B) by (unfold B; apply Rmax_case; apply is_float_abs, rnd_float).
  assert (t0 := low_sum B (2 * own) FB F2 ltac:(lra)). set (g := rnd (B + 2 * own)) in *.
  assert (t1 : (0.9995 * (6 * ex) - eta) * (0.9999 * B) <= v * (0.9999 * B)) by (apply Rmult_le_compat_r; lra).
  assert (t2 : v * (0.9999 * B) <= v * g) by (apply Rmult_le_compat_l; lra).
  assert (t3 : 0 <= v * g) by (apply Rmult_le_pos; lra).
  assert (t4 := low (v * g) t3). assert (t5 := rnd_pos (v * g) t3).
  assert (t6 := low_sum (rnd (v * g)) (4 * own) (rnd_float _) F4 ltac:(lra)).
  assert (t7 := rnd_pos (rnd (v * g) + 4 * own) ltac:(lra)).
  set (sum := rnd (rnd (v * g) + 4 * own)) in *.
  assert (t8 : 1.00999999 * sum <= sum * more) by (rewrite Rmult_comm; apply Rmult_le_compat_l; lra).
  assert (t9 := low (sum * more) ltac:(lra)). assert (t10 := rnd_pos (sum * more) ltac:(lra)).
  set (er := rnd (sum * more)) in *.
  assert (eB : 0 <= eta * B <= 1/1000 * (u * B)).
  { split; [apply Rmult_le_pos; lra|]. assert (eta * B <= 1/1000 * u * B) by (apply Rmult_le_compat_r; [lra | exact eta_u]). lra. }
  assert (xB : 0 <= ex * B) by (apply Rmult_le_pos; lra).
  assert (Er : 6 * (ex * B) + 4 * own - own / 100 <= er) by lra.
  (* the last rounding *)
  assert (Fn : is_float n) by apply rnd_float. assert (Fe : is_float er) by apply rnd_float.
  assert (Z1 := rnd_err_sum n (- er) Fn (is_float_opp _ Fe)). change (n + - er) with (n - er) in Z1.
  assert (Z2 := rnd_err_sum n er Fn Fe).
  assert (ut : u * Rabs t <= own / 16 + own / 1000).
  { assert (G : forall x y, Rabs (x - y) <= own -> 16 * u * Rabs x <= own -> u * Rabs y <= own / 16 + own / 1000).
    { intros x y H I. assert (Rabs y <= Rabs x + own).
      { replace y with (x + - (x - y)) by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
      assert (u * Rabs y <= u * (Rabs x + own)) by (apply Rmult_le_compat_l; lra).
      assert (u * own <= own / 1000) by (assert (u * own <= / 1000 * own) by (apply Rmult_le_compat_r; lra); lra). lra. }
    assert (Ga := G _ _ own_a rounds_a). assert (Gb := G _ _ own_b rounds_b). assert (Gc := G _ _ own_c rounds_c).
    replace t with (la * da' + lb * db' + lc * dc') by (unfold t, la, lb, lc; field; exact Tn).
    set (m := own / 16 + own / 1000) in *.
    assert (T3 : Rabs (la * da' + lb * db' + lc * dc') <= la * Rabs da' + lb * Rabs db' + lc * Rabs dc').
    { eapply Rle_trans; [apply Rabs_triang|]. assert (Q := Rabs_triang (la * da') (lb * db')).
      rewrite !Rabs_mult, (Rabs_pos_eq la), (Rabs_pos_eq lb) in Q by easy. rewrite Rabs_mult, (Rabs_pos_eq lc) by easy. lra. }
    assert (u * Rabs (la * da' + lb * db' + lc * dc') <= u * (la * Rabs da' + lb * Rabs db' + lc * Rabs dc')) by (apply Rmult_le_compat_l; lra).
    assert (la * (u * Rabs da') <= la * m) by (apply Rmult_le_compat_l; lra).
    assert (lb * (u * Rabs db') <= lb * m) by (apply Rmult_le_compat_l; lra).
    assert (lc * (u * Rabs dc') <= lc * m) by (apply Rmult_le_compat_l; lra).
    assert ((la + lb + lc) * m = m) by (rewrite L1; ring). lra. }
  assert (Nn : Rabs n <= Rabs t + er).
  { replace n with ((n + t) + - t) by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (ue : u * er <= 0.001 * er) by (apply Rmult_le_compat_r; lra).
  assert (Y1 : u * Rabs (n - er) <= u * (Rabs t + 2 * er)).
  { apply Rmult_le_compat_l; [lra|]. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, (Rabs_pos_eq er); lra. }
  assert (Y2 : u * Rabs (n + er) <= u * (Rabs t + 2 * er)).
  { apply Rmult_le_compat_l; [lra|]. eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_pos_eq er); lra. }
  clear - Z1 Z2 O Y1 Y2 ue ut Er xB Op seen_p t10.
  apply Rabs_le_inv in Z1, Z2, O. split; [lra|]. apply Rmin_glb; lra.
Qed.
End Near.
