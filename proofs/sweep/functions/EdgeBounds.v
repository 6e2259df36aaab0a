(** The edge functions of a triangle as edge_functions.py computes them, and what their bounds are
    worth.

    See "A triangle as four linear functions of the pixel" and "The bound, and what it proves" in
    docs/speed.md. A corner is a vector (p, q, w). Here: the formulas, rounding by rounding, and that
    the bounds, after the roundings of their own, are no less than what docs/speed.md says.
    EdgeRoundings.v has what the bounds have to cover, EdgeFunctions.v that they do.

    All is in real numbers, with [rnd] at every operation, as if there were no largest float. The code
    takes care of that: where `terms` < 2^1000 fails, every pixel is in doubt. Where it holds, an edge
    function and its bound are below 2^1004, since place <= far and weight <= high. T and its bound
    may still overflow; then |T| > error does not hold, or |T| is not finite, and T is not sure. *)
Require Import ZArith Reals Psatz String.
From Flocq Require Import Core Mult_error.
From Reftrace Require Import Geometry Trees Rounding.
Open Scope R_scope.

(** ** What is computed *)

(** From the pixel x0, y0 on. *)
Definition relative (x0 y0 : R) (v : vec) : vec :=
  V (rnd (vx v - rnd (x0 * vz v))) (rnd (vy v - rnd (y0 * vz v))) (vz v).

(** The coefficients of an edge: of x, of y and of 1; the function at a pixel, as in `_block`. *)
Definition of_x (a b : vec) : R := rnd (rnd (vy a * vz b) - rnd (vz a * vy b)).
Definition of_y (a b : vec) : R := rnd (rnd (vz a * vx b) - rnd (vx a * vz b)).
Definition of_1 (a b : vec) : R := rnd (rnd (vx a * vy b) - rnd (vy a * vx b)).
Definition at_pixel (c1 cy cx up right : R) : R := rnd (rnd (c1 + rnd (cy * up)) + rnd (cx * right)).
Definition edge_at (a b : vec) (up right : R) : R :=
  at_pixel (of_1 a b) (of_y a b) (of_x a b) up right.

(** T. *)
Definition volume (a b c : vec) : R :=
  rnd (rnd (rnd (vx a * of_x b c) + rnd (vy a * of_y b c)) + rnd (vz a * of_1 b c)).

(** The coefficients times the sign of T, which is 1 or -1. *)
Definition sign_of (x : R) : R := if Rlt_bool x 0 then -1 else 1.
Definition signed_edge (s : R) (a b : vec) (up right : R) : R :=
  at_pixel (rnd (of_1 a b * s)) (rnd (of_y a b * s)) (rnd (of_x a b * s)) up right.

(** The bounds. [more] is the float 1.01, [u] is 2^-53: 8 u and 50 u are floats. *)
Definition more : R := IZR 4548635623644201 * bpow radix2 (-52).
Definition tiny : R := bpow radix2 (-1000).
Definition largest6 (a b c d e f : R) : R := Rmax (Rmax (Rmax (Rmax (Rmax a b) c) d) e) f.
Definition span (a b c : vec) : R :=
  largest6 (Rabs (vx a)) (Rabs (vx b)) (Rabs (vx c)) (Rabs (vy a)) (Rabs (vy b)) (Rabs (vy c)).
Definition top (a b c : vec) : R := Rmax (Rmax (Rabs (vz a)) (Rabs (vz b))) (Rabs (vz c)).
Definition far_of (m place : R) : R := rnd (m + place).
Definition high_of (m weight : R) : R := rnd (m + weight).
Definition terms_of (reach far high : R) : R :=
  rnd (far * rnd (rnd (rnd (4 * reach) * high) + rnd (2 * far))).
Definition edge_error (reach place weight far high : R) : R :=
  let moved := rnd (rnd (rnd (4 * reach) * rnd (rnd (place * high) + rnd (far * weight)))
                    + rnd (rnd (4 * far) * place)) in
  rnd (rnd (more * rnd (moved + rnd (8 * u * terms_of reach far high))) + tiny).
Definition volume_error (place weight far high : R) : R :=
  let moved := rnd (rnd (6 * far) * rnd (rnd (rnd (2 * place) * high) + rnd (far * weight))) in
  rnd (rnd (more * rnd (moved + rnd (rnd (rnd (50 * u * far) * far) * high))) + tiny).

(** ** Facts about roundings *)

Lemma more_value : 1.00999999 <= more <= 1.01000001.
Proof. unfold more. simpl. split; lra. Qed.
Lemma tiny_eta : 1000000000000000000000 * eta <= tiny.
Proof.
  unfold eta, tiny. change (-1000)%Z with (74 + -1074)%Z. rewrite bpow_plus.
  generalize (bpow_gt_0 radix2 (-1074)). generalize (bpow radix2 (-1074)). intros t H. simpl. lra.
Qed.

(** Lower ends of what is not negative. One rounding takes far less than a 10,000th. *)
Lemma low x : 0 <= x -> 9999/10000 * x - eta <= rnd x.
Proof.
  intros H. generalize (rnd_err x) u_small u_pos. rewrite (Rabs_pos_eq x H). intros E U P.
  apply Rabs_le_inv in E. nra.
Qed.
Lemma low_rel x : bpow radix2 (-1022) <= x -> 9999/10000 * x <= rnd x.
Proof.
  intros H. assert (0 < x) by (generalize (bpow_gt_0 radix2 (-1022)); lra).
  assert (E := rnd_err_rel x). rewrite (Rabs_pos_eq x) in E by lra. specialize (E H).
  generalize u_small u_pos. apply Rabs_le_inv in E. nra.
Qed.
Lemma low_sum x y : is_float x -> is_float y -> 0 <= x + y -> 9999/10000 * (x + y) <= rnd (x + y).
Proof.
  intros X Y H. generalize (rnd_err_sum x y X Y) u_small u_pos. rewrite (Rabs_pos_eq _ H). intros E U P.
  apply Rabs_le_inv in E. nra.
Qed.

(** A power of two times a float is a float. *)
Lemma float_pow x n : (0 <= n)%Z -> is_float x -> is_float (x * bpow radix2 n).
Proof. intros N F. apply mult_bpow_pos_exact_FLT; auto. Qed.
Lemma rnd_2 x : is_float x -> rnd (2 * x) = 2 * x.
Proof.
  intros F. apply rnd_id. replace (2 * x) with (x * bpow radix2 1) by (change (bpow radix2 1) with 2; ring).
  now apply float_pow.
Qed.
Lemma rnd_4 x : is_float x -> rnd (4 * x) = 4 * x.
Proof.
  intros F. apply rnd_id. replace (4 * x) with (x * bpow radix2 2) by (change (bpow radix2 2) with 4; ring).
  now apply float_pow.
Qed.
Lemma tiny_float : is_float tiny.
Proof. apply generic_format_bpow. unfold fexp, FLT_exp, prec. lia. Qed.

(** The sign goes through every rounding. *)
Lemma signed_edge_sign s a b up right : s = 1 \/ s = -1 ->
  signed_edge s a b up right = s * edge_at a b up right.
Proof.
  unfold signed_edge, edge_at, at_pixel.
  assert (F1 : rnd (of_1 a b) = of_1 a b) by (apply rnd_id, rnd_float).
  assert (Fy : rnd (of_y a b) = of_y a b) by (apply rnd_id, rnd_float).
  assert (Fx : rnd (of_x a b) = of_x a b) by (apply rnd_id, rnd_float).
  intros [-> | ->].
  - rewrite !Rmult_1_r, F1, Fy, Fx. ring.
  - replace (of_1 a b * -1) with (- of_1 a b) by ring. replace (of_y a b * -1) with (- of_y a b) by ring.
    replace (of_x a b * -1) with (- of_x a b) by ring. rewrite !rnd_opp, F1, Fy, Fx.
    rewrite <- !Ropp_mult_distr_l, !rnd_opp, <- Ropp_plus_distr, rnd_opp, <- Ropp_plus_distr, rnd_opp. ring.
Qed.

(** ** The bounds, from below: what they are worth after their own roundings *)

Section Low.
Variables m w place weight reach : R. (* the largest |p|, |q| and |w|, as computed *)
Hypothesis fm : is_float m. Hypothesis fw : is_float w.
Hypothesis fplace : is_float place. Hypothesis fweight : is_float weight.
Hypothesis freach : is_float reach.
Hypothesis pm : 0 <= m. Hypothesis pw : 0 <= w.
Hypothesis pplace : 0 <= place. Hypothesis pweight : 0 <= weight.
Hypothesis preach : 1 <= reach <= 4294967296.
Hypothesis not_tiny : bpow radix2 (-1009) <= w + weight.

Let f := m + place.
Let h := w + weight.
Let far := far_of m place.
Let high := high_of w weight.

Lemma pf : 0 <= f. Proof. unfold f. lra. Qed.
Lemma ph : 0 <= h. Proof. unfold h. lra. Qed.
Lemma far_low : 9999/10000 * f <= far. Proof. apply low_sum; auto. apply pf. Qed.
Lemma high_low : 9999/10000 * h <= high. Proof. apply low_sum; auto. apply ph. Qed.
Lemma far_float : is_float far. Proof. apply rnd_float. Qed.
Lemma high_float : is_float high. Proof. apply rnd_float. Qed.

Lemma high_normal : bpow radix2 (-1010) <= high.
Proof.
  generalize high_low. unfold h in *. revert not_tiny.
  change (-1009)%Z with (1 + -1010)%Z. rewrite bpow_plus. generalize (bpow_gt_0 radix2 (-1010)).
  generalize (bpow radix2 (-1010)). intros x. change (bpow radix2 1) with 2. intros. lra.
Qed.

Lemma times_low a b x y : 0 <= a -> 0 <= b -> 9999/10000 * a <= x -> 9999/10000 * b <= y ->
  0 <= x * y /\ 99980001/100000000 * (a * b) <= x * y.
Proof.
  intros A B X Y. assert ((9999/10000 * a) * (9999/10000 * b) <= x * y)
    by (apply Rmult_le_compat; lra).
  assert (0 <= a * b) by now apply Rmult_le_pos. lra.
Qed.

(** place high + far weight. *)
Lemma moved_low :
  0.9996 * (place * h + f * weight) - 2 * eta <= rnd (rnd (place * high) + rnd (far * weight)).
Proof.
  assert (F := pf). assert (H := ph). assert (N := eta_pos).
  destruct (times_low place h place high) as [P1 Q1]; auto using high_low; [lra|].
  destruct (times_low f weight far weight) as [P2 Q2]; auto using far_low; [lra|].
  assert (L1 := low _ P1). assert (L2 := low _ P2).
  assert (R1 := rnd_pos _ P1). assert (R2 := rnd_pos _ P2).
  assert (L3 := low_sum (rnd (place * high)) (rnd (far * weight)) (rnd_float _) (rnd_float _) ltac:(lra)).
  assert (0 <= place * h) by now apply Rmult_le_pos.
  assert (0 <= f * weight) by now apply Rmult_le_pos. lra.
Qed.

Lemma terms_low :
  0.9994 * (4 * reach * (f * h) + 2 * (f * f)) - eta <= terms_of reach far high.
Proof.
  assert (F := pf). assert (H := ph). assert (N := eta_pos). unfold terms_of.
  rewrite (rnd_4 _ freach), (rnd_2 _ far_float).
  assert (Lh := high_low). assert (Lf := far_low). assert (Nh := high_normal).
  assert (L1 : 9999/10000 * (4 * reach * high) <= rnd (4 * reach * high)).
  { apply low_rel. assert (1 * high <= 4 * reach * high) by (apply Rmult_le_compat_r; lra).
    assert (bpow radix2 (-1022) <= bpow radix2 (-1010)) by (apply bpow_le; lia). lra. }
  assert (L1' : 9999/10000 * (4 * reach * (9999/10000 * h)) <= rnd (4 * reach * high)).
  { eapply Rle_trans; [|exact L1]. apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; lra. }
  assert (0 <= reach * h) by (apply Rmult_le_pos; lra).
  assert (F2 : is_float (2 * far)).
  { rewrite <- (rnd_2 _ far_float). apply rnd_float. }
  assert (L3 := low_sum (rnd (4 * reach * high)) (2 * far) (rnd_float _) F2 ltac:(lra)).
  set (t3 := rnd (rnd (4 * reach * high) + 2 * far)) in *.
  assert (T3 : 9996/10000 * (4 * reach * h + 2 * f) <= t3) by lra.
  assert (P : (9999/10000 * f) * (9996/10000 * (4 * reach * h + 2 * f)) <= far * t3).
  { apply Rmult_le_compat; lra. }
  assert (0 <= f * (4 * reach * h + 2 * f)) by (apply Rmult_le_pos; lra).
  assert (L4 := low (far * t3) ltac:(lra)). lra.
Qed.

Theorem edge_error_low :
  1.008 * (4 * reach * (place * h + f * weight) + 4 * (f * place)
           + 8 * u * (4 * reach * (f * h) + 2 * (f * f))) + 1/2 * tiny
  <= edge_error reach place weight far high.
Proof.
  assert (F := pf). assert (H := ph). assert (N := eta_pos). assert (U := u_pos). assert (V := u_small).
  assert (Y := tiny_eta). assert (M := more_value).
  unfold edge_error. rewrite (rnd_4 _ freach), (rnd_4 _ far_float).
  assert (M0 := moved_low). set (s := rnd (rnd (place * high) + rnd (far * weight))) in *.
  assert (S0 : 0 <= s).
  { apply rnd_pos, Rplus_le_le_0_compat; apply rnd_pos, Rmult_le_pos; auto;
      generalize high_low far_low pf ph; lra. }
  assert (X1 : 0 <= place * h + f * weight)
    by (apply Rplus_le_le_0_compat; now apply Rmult_le_pos).
  assert (K1 : 4 * reach * (0.9996 * (place * h + f * weight) - 2 * eta) <= 4 * reach * s)
    by (apply Rmult_le_compat_l; lra).
  assert (Z1 : 0 <= 4 * reach * s) by (apply Rmult_le_pos; lra).
  assert (L1 := low _ Z1). assert (Z1' := rnd_pos _ Z1).
  destruct (times_low f place far place) as [P2 Q2]; auto using far_low; [lra|].
  assert (L2 := low (4 * far * place) ltac:(lra)).
  assert (Z2 : 0 <= rnd (4 * far * place)) by (apply rnd_pos; lra).
  assert (L3 := low_sum _ _ (rnd_float (4 * reach * s)) (rnd_float (4 * far * place)) ltac:(lra)).
  set (e1 := rnd (rnd (4 * reach * s) + rnd (4 * far * place))) in *.
  assert (T := terms_low). set (t := terms_of reach far high) in *.
  assert (T0 : 0 <= t).
  { unfold t, terms_of. repeat first [apply rnd_pos | apply Rplus_le_le_0_compat | apply Rmult_le_pos];
      try lra; generalize high_low far_low pf ph; lra. }
  assert (K4 : 8 * u * (0.9994 * (4 * reach * (f * h) + 2 * (f * f)) - eta) <= 8 * u * t)
    by (apply Rmult_le_compat_l; lra).
  assert (U0 : 0 <= 8 * u * t) by (apply Rmult_le_pos; lra).
  assert (L4 := low _ U0). assert (U0' := rnd_pos _ U0).
  assert (E0 : 0 <= e1) by (apply rnd_pos; lra).
  assert (L5 := low_sum e1 _ (rnd_float _) (rnd_float (8 * u * t)) ltac:(lra)).
  set (e3 := rnd (e1 + rnd (8 * u * t))) in *.
  assert (E3 : 0 <= e3) by (apply rnd_pos; lra).
  assert (K6 : 1.00999999 * e3 <= more * e3) by (apply Rmult_le_compat_r; lra).
  assert (L6 := low (more * e3) ltac:(lra)).
  assert (E6 : 0 <= rnd (more * e3)) by (apply rnd_pos; lra).
  assert (L7 := low_sum _ _ (rnd_float (more * e3)) tiny_float ltac:(generalize (bpow_gt_0 radix2 (-1000));
    fold tiny; lra)).
  eapply Rle_trans; [|exact L7]. clear L7.
  assert (Reta : reach * eta <= 4294967296 * eta) by (apply Rmult_le_compat_r; lra).
  assert (Ueta : u * eta <= 1 * eta) by (apply Rmult_le_compat_r; lra).
  assert (0 <= f * place) by now apply Rmult_le_pos.
  assert (0 <= u * (4 * reach * (f * h) + 2 * (f * f))).
  { apply Rmult_le_pos; [lra|]. apply Rplus_le_le_0_compat; [|generalize (Rmult_le_pos f f F F); lra].
    apply Rmult_le_pos; [lra | now apply Rmult_le_pos]. }
  assert (0 <= reach * (place * h + f * weight)) by (apply Rmult_le_pos; lra).
  lra.
Qed.

(** No corner's w is far larger than the error of its p: the errors of both grow with its size. *)
Hypothesis place_not_tiny : w + weight <= bpow radix2 60 * place.

Lemma scaled n x : (0 <= n)%Z -> x <= bpow radix2 n -> eta * x <= / 2 * bpow radix2 (n - 1074).
Proof.
  intros N X. unfold eta. replace (n - 1074)%Z with (-1074 + n)%Z by lia. rewrite bpow_plus.
  generalize (bpow_gt_0 radix2 (-1074)). intros. nra.
Qed.
Lemma eta_small x : x <= bpow radix2 60 -> eta * x <= 1/10000 * tiny.
Proof.
  intros X. eapply Rle_trans; [apply (scaled 60); [lia | exact X]|]. unfold tiny.
  change (-1000)%Z with (14 + (60 - 1074))%Z. rewrite (bpow_plus _ 14). change (bpow radix2 14) with 16384.
  generalize (bpow_gt_0 radix2 (60 - 1074)). lra.
Qed.
Lemma u_bpow : u = bpow radix2 (-53).
Proof. unfold u. change (-53)%Z with (-1 + -52)%Z. rewrite bpow_plus. reflexivity. Qed.

Lemma pos3 : 0 <= u * (f * f * h).
Proof.
  generalize pf ph u_pos. intros F H U. apply Rmult_le_pos; [lra|].
  apply Rmult_le_pos; [now apply Rmult_le_pos | exact H].
Qed.
Lemma eta_far : eta * f <= 1/10000 * tiny + 1/100 * (u * (f * f * h)).
Proof.
  assert (F := pf). assert (H := ph). assert (N := eta_pos). assert (U := u_pos).
  assert (T := bpow_gt_0 radix2 (-1000)). fold tiny in T.
  assert (0 <= u * (f * f * h)) by exact pos3.
  destruct (Rle_or_lt f (bpow radix2 60)) as [X|X]; [generalize (eta_small f X); lra|].
  assert (bpow radix2 60 * bpow radix2 (-1009) <= f * h).
  { apply Rmult_le_compat; try apply bpow_ge_0; unfold h; lra. }
  rewrite <- bpow_plus in *. simpl Z.add in *.
  assert (K : bpow radix2 (-1002) <= u * (f * h)).
  { rewrite u_bpow. change (-1002)%Z with (-53 + -949)%Z. rewrite bpow_plus.
    apply Rmult_le_compat_l; [apply bpow_ge_0 | lra]. }
  assert (E : eta <= 1/100 * bpow radix2 (-1002)).
  { unfold eta. change (-1002)%Z with (72 + -1074)%Z. rewrite bpow_plus.
    generalize (bpow_gt_0 radix2 (-1074)). generalize (bpow radix2 (-1074)). intros. simpl. lra. }
  assert (eta * f <= 1/100 * (u * (f * h)) * f) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Lemma eta_high : eta * h <= 1/10000 * tiny + 1/100 * (u * (f * f * h)).
Proof.
  assert (F := pf). assert (H := ph). assert (N := eta_pos). assert (U := u_pos).
  assert (T := bpow_gt_0 radix2 (-1000)). fold tiny in T.
  assert (0 <= u * (f * f * h)) by exact pos3.
  destruct (Rle_or_lt h (bpow radix2 60)) as [X|X]; [generalize (eta_small h X); lra|].
  assert (1 < place).
  { apply (Rmult_lt_reg_l (bpow radix2 60)); [apply bpow_gt_0|]. unfold h in X. lra. }
  assert (1 <= f) by (unfold f; lra).
  assert (E : eta <= 1/100 * u).
  { rewrite u_bpow. unfold eta. change (-53)%Z with (1021 + -1074)%Z. rewrite bpow_plus.
    assert (bpow radix2 10 <= bpow radix2 1021) by (apply bpow_le; lia).
    change (bpow radix2 10) with 1024 in *. generalize (bpow_gt_0 radix2 (-1074)). nra. }
  assert (1 * 1 * h <= f * f * h).
  { apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat; lra. }
  assert (u * h <= u * (f * f * h)) by (apply Rmult_le_compat_l; lra).
  assert (eta * h <= 1/100 * u * h) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Theorem volume_error_low :
  1.007 * (6 * f * (2 * (place * h) + f * weight)) + 49 * (u * (f * f * h)) + 1/2 * tiny
  <= volume_error place weight far high.
Proof.
  assert (F := pf). assert (H := ph). assert (N := eta_pos). assert (U := u_pos). assert (V := u_small).
  assert (Y := tiny_eta). assert (M := more_value). assert (Ef := eta_far). assert (Eh := eta_high).
  assert (Ft := far_float). assert (Lf := far_low). assert (Lh := high_low).
  unfold volume_error. rewrite (rnd_2 _ fplace).
  assert (F6 : 9999/10000 * (6 * far) <= rnd (6 * far)).
  { replace (6 * far) with (4 * far + 2 * far) by ring.
    apply low_sum; [rewrite <- rnd_4 by easy; apply rnd_float | rewrite <- rnd_2 by easy;
      apply rnd_float | lra]. }
  destruct (times_low place h place high) as [P1 Q1]; auto; [lra|].
  destruct (times_low f weight far weight) as [P2 Q2]; auto; [lra|].
  assert (P1' : 0 <= 2 * place * high) by lra.
  assert (L1 := low _ P1'). assert (L2 := low _ P2).
  assert (R1 := rnd_pos _ P1'). assert (R2 := rnd_pos _ P2).
  assert (L3 := low_sum (rnd (2 * place * high)) (rnd (far * weight)) (rnd_float _) (rnd_float _) ltac:(lra)).
  set (s := rnd (rnd (2 * place * high) + rnd (far * weight))) in *.
  assert (0 <= place * h) by now apply Rmult_le_pos.
  assert (0 <= f * weight) by now apply Rmult_le_pos.
  assert (S0 : 0 <= s) by (apply rnd_pos; lra).
  assert (S1 : 0.9996 * (2 * (place * h) + f * weight) - 2 * eta <= s) by lra.
  assert (K1 : 5.9988 * f * (0.9996 * (2 * (place * h) + f * weight) - 2 * eta) <= 5.9988 * f * s)
    by (apply Rmult_le_compat_l; lra).
  assert (K2 : 5.9988 * f * s <= rnd (6 * far) * s) by (apply Rmult_le_compat_r; lra).
  assert (0 <= 5.9988 * f * s) by (apply Rmult_le_pos; lra).
  assert (0 <= f * (2 * (place * h) + f * weight)) by (apply Rmult_le_pos; lra).
  assert (L4 := low (rnd (6 * far) * s) ltac:(lra)).
  assert (Z4 := rnd_pos (rnd (6 * far) * s) ltac:(lra)).
  set (moved := rnd (rnd (6 * far) * s)) in *.
  (* 50 u far far high *)
  assert (G0 : 0 <= u * (f * f * h)) by exact pos3.
  assert (G : exists r, 0 <= r /\ 49.98 * (u * (f * f * h)) - eta <= r * f * h /\ r <= rnd (50 * u * far)).
  { destruct (Rle_or_lt (bpow radix2 (-900)) far) as [B|B].
    - exists (49.99 * (u * f)). assert (0 <= u * f) by (apply Rmult_le_pos; lra).
      split; [lra|]. split; [lra|].
      assert (u * (9999/10000 * f) <= u * far) by (apply Rmult_le_compat_l; lra).
      eapply Rle_trans; [|apply low_rel]. 1: { lra. }
      rewrite u_bpow. assert (bpow radix2 (-53) * bpow radix2 (-900) <= bpow radix2 (-53) * far)
        by (apply Rmult_le_compat_l; [apply bpow_ge_0 | lra]).
      rewrite <- bpow_plus in *. simpl Z.add in *.
      assert (bpow radix2 (-1022) <= bpow radix2 (-953)) by (apply bpow_le; lia).
      generalize (bpow_gt_0 radix2 (-1022)). lra.
    - exists 0. split; [lra|]. split; [|apply rnd_pos, Rmult_le_pos; lra]. rewrite !Rmult_0_l.
      assert (A : f <= bpow radix2 (-899)).
      { change (-899)%Z with (1 + -900)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2. lra. }
      assert (C : h <= bpow radix2 60 * bpow radix2 (-899)).
      { unfold h. eapply Rle_trans; [exact place_not_tiny|]. apply Rmult_le_compat_l; [apply bpow_ge_0|].
        unfold f in A. lra. }
      rewrite <- bpow_plus in C. simpl Z.add in C.
      assert (D : f * f * h <= bpow radix2 (-899) * bpow radix2 (-899) * bpow radix2 (-839)).
      { apply Rmult_le_compat; [now apply Rmult_le_pos | lra | apply Rmult_le_compat; lra | lra]. }
      rewrite <- !bpow_plus in D. simpl Z.add in D.
      assert (bpow radix2 (-2637) <= bpow radix2 (-1074)) by (apply bpow_le; lia).
      assert (u * (f * f * h) <= u * bpow radix2 (-1074)) by (apply Rmult_le_compat_l; lra).
      assert (u * bpow radix2 (-1074) <= / 1000 * bpow radix2 (-1074))
        by (apply Rmult_le_compat_r; [apply bpow_ge_0 | lra]).
      unfold eta. lra. }
  destruct G as [r [G1 [G2 G3]]].
  assert (B1 : r * (9999/10000 * f) <= rnd (50 * u * far) * far) by (apply Rmult_le_compat; lra).
  assert (B0 : 0 <= r * f) by now apply Rmult_le_pos.
  assert (L5 := low (rnd (50 * u * far) * far) ltac:(lra)).
  assert (Z5 := rnd_pos (rnd (50 * u * far) * far) ltac:(lra)).
  set (r2 := rnd (rnd (50 * u * far) * far)) in *.
  assert (B2 : r2 * (9999/10000 * h) <= r2 * high) by (apply Rmult_le_compat_l; lra).
  assert (B3 : (9998/10000 * (r * f) - eta) * h <= r2 * h) by (apply Rmult_le_compat_r; lra).
  assert (B4 : 0 <= r2 * h) by now apply Rmult_le_pos.
  assert (L6 := low (r2 * high) ltac:(lra)).
  assert (Z6 := rnd_pos (r2 * high) ltac:(lra)).
  set (r3 := rnd (r2 * high)) in *.
  assert (L7 := low_sum moved r3 (rnd_float _) (rnd_float _) ltac:(lra)).
  assert (Z7 := rnd_pos (moved + r3) ltac:(lra)).
  set (e3 := rnd (moved + r3)) in *.
  assert (K8 : 1.00999999 * e3 <= more * e3) by (apply Rmult_le_compat_r; lra).
  assert (L8 := low (more * e3) ltac:(lra)).
  assert (Z8 := rnd_pos (more * e3) ltac:(lra)).
  assert (L9 := low_sum _ _ (rnd_float (more * e3)) tiny_float
    ltac:(generalize (bpow_gt_0 radix2 (-1000)); fold tiny; lra)).
  eapply Rle_trans; [|exact L9]. clear L9.
  assert (0 <= eta * h) by (apply Rmult_le_pos; lra).
  assert (0 <= eta * f) by (apply Rmult_le_pos; lra).
  lra.
Qed.
End Low.
