(** The fourth function, how near a triangle is at a pixel: what is common to both projections.

    See "A triangle as four linear functions of the pixel" in docs/speed.md; the code is the second half
    of `set_up` in edge_functions.py. It is asked where T is sure: |T| > error. Here are the formulas,
    and what rounding does to a coefficient and to the function at a pixel. NearnessPixel.v has the
    premises; NearnessPerspective.v and NearnessParallel.v have the bounds.

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
Definition coefficient (a b c : vec) (of : vec -> vec -> R) : R :=
  let s := sign_of (volume a b c) in
  summed (Rabs (volume a b c)) (rnd (of b c * s)) (rnd (of c a * s)) (rnd (of a b * s)).
Definition near_perspective (a b c : vec) (up right : R) : R :=
  at_pixel (coefficient a b c of_1) (coefficient a b c of_y) (coefficient a b c of_x) up right.
Definition perspective_error (e_max t_max amount ray_error nearest : R) : R :=
  let least := rnd (amount - t_max) in
  let relative := rnd (rnd (t_max / least) + rnd (rnd (2 * ray_error) + 16 * u)) in
  rnd (rnd (rnd (rnd (6 * e_max) / least) + rnd (relative * nearest)) * more).

(** Parallel rays: b and c are the depths of those corners, less that of the first, [base]. *)
Definition mixed (amount f1 f2 b c : R) : R := rnd (rnd (rnd (f1 * b) + rnd (f2 * c)) / (- amount)).
Definition coefficient_p (a b c : vec) (da db dc : R) (of : vec -> vec -> R) : R :=
  let s := sign_of (volume a b c) in
  mixed (Rabs (volume a b c)) (rnd (of c a * s)) (rnd (of a b * s)) (rnd (db - da)) (rnd (dc - da)).
Definition near_parallel (a b c : vec) (up right da db dc : R) : R :=
  let coefficient := coefficient_p a b c da db dc in
  at_pixel (rnd (coefficient of_1 - da)) (coefficient of_y) (coefficient of_x) up right.
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
