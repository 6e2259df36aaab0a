(** The premises of the nearness, and what both projections need of them.

    The premises stand here once, as a class: a file that has `Context {given : sure_pixel}` may name its
    fields, and the numbers defined below, as if they were variables. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding EdgeFunctions NearnessCommon.
Open Scope R_scope.
Local Opaque u eta.

(** A triangle's corners as computed (a, b, c) and as the pixel's ray sees them (a', b', c'), and a pixel.
    T, as computed, is larger than its bound: so its sign is known. *)
Class sure_pixel := Sure_pixel {
  place : R; weight : R; reach : R;
  a : vec; b : vec; c : vec; a' : vec; b' : vec; c' : vec;
  up : R; right : R;
  ok : fit place weight reach a b c a' b' c';
  in_up : Rabs up <= reach;
  in_right : Rabs right <= reach;
  T_sure : Rabs (volume a b c)
    > volume_error place weight (far_of (span a b c) place) (high_of (top a b c) weight)
}.

Section Near.
Context {given : sure_pixel}.
Definition far := far_of (span a b c) place.
Definition high := high_of (top a b c) weight.
Definition e_max := edge_error reach place weight far high.
Definition t_max := volume_error place weight far high.
Definition amount := Rabs (volume a b c).
Definition s := sign_of (volume a b c).
Lemma sure : amount > t_max. Proof. exact T_sure. Qed.
Definition d := pixel_ray up right.
Definition T := det a' b' c'.
Definition e_bc := det b' c' d.
Definition e_ca := det c' a' d.
Definition e_ab := det a' b' d.

(** X is what the errors of the corners move, Y is what one rounding does: E >= X + 8 Y. *)
Definition f := span a b c + place.
Definition h := top a b c + weight.
Definition X := 4 * reach * (place * h + f * weight) + 4 * (f * place).
Definition Y := u * (4 * reach * (f * h) + 2 * (f * f)).

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
Definition slack := 20 * (reach * eta).

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
  split; [|split; [exact (P sure)|]].
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
