(** The edge functions of a triangle, and the bound on what rounding does to them.

    See "A triangle as four linear functions of the pixel" and "The bound, and what it proves" in
    docs/speed.md; the code is edge_functions.py. A corner is a vector (p, q, w). What Film.v says:
    for the stored ray of a pixel there are exact corners a', b', c', off by at most [place] in p and
    q and by [weight] in w, for which the exact edge functions have the signs of the determinants
    below. Here: how far what is computed may be from those determinants.

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
  assert (L7 := low_sum _ _ (rnd_float (more * e3)) tiny_float ltac:(generalize (bpow_gt_0 radix2 (-1000)); fold tiny; lra)).
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
    apply low_sum; [rewrite <- rnd_4 by easy; apply rnd_float | rewrite <- rnd_2 by easy; apply rnd_float | lra]. }
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

(** ** What rounding does *)

Definition float_vec (v : vec) : Prop := is_float (vx v) /\ is_float (vy v) /\ is_float (vz v).
Definition within (m k : R) (v : vec) : Prop :=
  Rabs (vx v) <= m /\ Rabs (vy v) <= m /\ Rabs (vz v) <= k.
Definition close (place weight : R) (v v' : vec) : Prop :=
  Rabs (vx v - vx v') <= place /\ Rabs (vy v - vy v') <= place /\ Rabs (vz v - vz v') <= weight.
Definition pixel_ray (up right : R) : vec := V right up 1.

Section Rounded.
Local Open Scope string_scope.
Let v3 (v : vec) (k : nat) : R := match k with 0%nat => vx v | 1%nat => vy v | _ => vz v end.
Let env (a b c : vec) (up right : R) : renv := REnv (fun n =>
  if String.eqb n "ap" then vx a else if String.eqb n "aq" then vy a else if String.eqb n "aw" then vz a else
  if String.eqb n "bp" then vx b else if String.eqb n "bq" then vy b else if String.eqb n "bw" then vz b else
  if String.eqb n "cp" then vx c else if String.eqb n "cq" then vy c else if String.eqb n "cw" then vz c else
  if String.eqb n "up" then up else right) (fun _ => true).
Let cx (p q r s : string) := Sub (Mul (Var p) (Var q)) (Mul (Var r) (Var s)).
Let tree_e := Add (Add (cx "ap" "bq" "aq" "bp") (Mul (cx "aw" "bp" "ap" "bw") (Var "up")))
                  (Mul (cx "aq" "bw" "aw" "bq") (Var "right")).
Let tree_T := Add (Add (Mul (Var "ap") (cx "bq" "cw" "bw" "cq")) (Mul (Var "aq") (cx "bw" "cp" "bp" "cw")))
                  (Mul (Var "aw") (cx "bp" "cq" "bq" "cp")).

Lemma A_5 : A 5 <= 1 + 6 * u.
Proof. unfold A. rewrite u_value. simpl. lra. Qed.

Lemma env_floats a b c up right : float_vec a -> float_vec b -> float_vec c -> is_float up ->
  is_float right -> forall n, is_float (r_var (env a b c up right) n).
Proof.
  intros [A1 [A2 A3]] [B1 [B2 B3]] [C1 [C2 C3]] U R n. simpl.
  repeat match goal with |- is_float (if ?x then _ else _) => destruct x; [assumption|] end. assumption.
Qed.

Lemma product_le x y X Y : Rabs x <= X -> Rabs y <= Y -> Rabs x * Rabs y <= X * Y.
Proof. intros. apply Rmult_le_compat; auto using Rabs_pos. Qed.

Lemma edge_rounding a b up right m k r : float_vec a -> float_vec b -> is_float up -> is_float right ->
  within m k a -> within m k b -> Rabs up <= r -> Rabs right <= r ->
  Rabs (edge_at a b up right - det a b (pixel_ray up right))
  <= 6 * u * (4 * r * (m * k) + 2 * (m * m)) + (1 + 6 * u) * (5 + 4 * r) * eta.
Proof.
  intros Fa Fb Fu Fr [Ax [Ay Az]] [Bx [By_ Bz]] U R.
  assert (E := error (env a b a up right) (env_floats a b a up right Fa Fb Fa Fu Fr) tree_e).
  assert (G : ring_expr tree_e) by (simpl; repeat split). specialize (E G). clear G.
  change (fl (env a b a up right) tree_e) with (edge_at a b up right) in E.
  replace (ex (env a b a up right) tree_e) with (det a b (pixel_ray up right)) in E
    by (unfold det, dot, cross; simpl; ring).
  eapply Rle_trans; [exact E|]. clear E.
  change (Rounding.depth tree_e) with 5%nat.
  assert (Um := u_pos). assert (N := eta_pos). assert (K := A_5). assert (K1 := A_ge_1 5).
  set (s1 := Rabs (vx a) * Rabs (vy b) + Rabs (vy a) * Rabs (vx b)).
  set (sy := Rabs (vz a) * Rabs (vx b) + Rabs (vx a) * Rabs (vz b)).
  set (sx := Rabs (vy a) * Rabs (vz b) + Rabs (vz a) * Rabs (vy b)).
  replace (mag (env a b a up right) tree_e) with (s1 + sy * Rabs up + sx * Rabs right)
    by (unfold s1, sy, sx; simpl; ring).
  replace (room (env a b a up right) tree_e)
    with (s1 + sy * Rabs up + sx * Rabs right + (4 + 2 * Rabs up + 2 * Rabs right) * eta)
    by (unfold s1, sy, sx; simpl; ring).
  assert (S1 : s1 <= 2 * (m * m)) by (generalize (product_le _ _ _ _ Ax By_) (product_le _ _ _ _ Ay Bx); unfold s1; lra).
  assert (Sy : sy <= 2 * (m * k)) by (generalize (product_le _ _ _ _ Az Bx) (product_le _ _ _ _ Ax Bz); unfold sy; lra).
  assert (Sx : sx <= 2 * (m * k)) by (generalize (product_le _ _ _ _ Ay Bz) (product_le _ _ _ _ Az By_); unfold sx; lra).
  assert (P : forall x y, 0 <= Rabs x * Rabs y) by (intros; apply Rmult_le_pos; apply Rabs_pos).
  assert (0 <= s1) by (unfold s1; generalize (P (vx a) (vy b)) (P (vy a) (vx b)); lra).
  assert (0 <= sy) by (unfold sy; generalize (P (vz a) (vx b)) (P (vx a) (vz b)); lra).
  assert (0 <= sx) by (unfold sx; generalize (P (vy a) (vz b)) (P (vz a) (vy b)); lra).
  assert (sy * Rabs up <= 2 * (m * k) * r) by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (sx * Rabs right <= 2 * (m * k) * r) by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (0 <= sy * Rabs up) by (apply Rmult_le_pos; auto using Rabs_pos).
  assert (0 <= sx * Rabs right) by (apply Rmult_le_pos; auto using Rabs_pos).
  set (mg := s1 + sy * Rabs up + sx * Rabs right) in *.
  assert (Hmg : mg <= 4 * r * (m * k) + 2 * (m * m)) by (unfold mg; lra).
  assert (Hz : (4 + 2 * Rabs up + 2 * Rabs right) * eta <= (5 + 4 * r) * eta)
    by (apply Rmult_le_compat_r; lra).
  assert (Q : (A 5 - 1) * mg <= 6 * u * (4 * r * (m * k) + 2 * (m * m)))
    by (apply Rmult_le_compat; unfold mg; lra).
  assert (Z : 0 <= (4 + 2 * Rabs up + 2 * Rabs right) * eta)
    by (apply Rmult_le_pos; generalize (Rabs_pos up) (Rabs_pos right); lra).
  assert (Q2 : A 5 * ((4 + 2 * Rabs up + 2 * Rabs right) * eta) <= (1 + 6 * u) * ((5 + 4 * r) * eta))
    by (apply Rmult_le_compat; lra).
  lra.
Qed.

Lemma volume_rounding a b c m k : float_vec a -> float_vec b -> float_vec c ->
  within m k a -> within m k b -> within m k c ->
  Rabs (volume a b c - det a b c)
  <= 36 * (u * (m * m * k)) + (1 + 6 * u) * (3 + 4 * m + 2 * k) * eta.
Proof.
  intros Fa Fb Fc [Ax [Ay Az]] [Bx [By_ Bz]] [Cx [Cy Cz]].
  assert (Z0 : is_float 0) by apply generic_format_0.
  assert (E := error (env a b c 0 0) (env_floats a b c 0 0 Fa Fb Fc Z0 Z0) tree_T).
  assert (G : ring_expr tree_T) by (simpl; repeat split). specialize (E G). clear G.
  change (fl (env a b c 0 0) tree_T) with (volume a b c) in E.
  replace (ex (env a b c 0 0) tree_T) with (det a b c) in E
    by (unfold det, dot, cross; simpl; ring).
  eapply Rle_trans; [exact E|]. clear E.
  change (Rounding.depth tree_T) with 5%nat.
  assert (Um := u_pos). assert (N := eta_pos). assert (K := A_5). assert (K1 := A_ge_1 5).
  set (s1 := Rabs (vx b) * Rabs (vy c) + Rabs (vy b) * Rabs (vx c)).
  set (sy := Rabs (vz b) * Rabs (vx c) + Rabs (vx b) * Rabs (vz c)).
  set (sx := Rabs (vy b) * Rabs (vz c) + Rabs (vz b) * Rabs (vy c)).
  set (mg := Rabs (vx a) * sx + Rabs (vy a) * sy + Rabs (vz a) * s1).
  set (et := (3 + 2 * Rabs (vx a) + 2 * Rabs (vy a) + 2 * Rabs (vz a)) * eta).
  replace (mag (env a b c 0 0) tree_T) with mg by (unfold mg, s1, sy, sx; simpl; ring).
  replace (room (env a b c 0 0) tree_T) with (mg + et) by (unfold mg, et, s1, sy, sx; simpl; ring).
  assert (S1 : s1 <= 2 * (m * m)) by (generalize (product_le _ _ _ _ Bx Cy) (product_le _ _ _ _ By_ Cx); unfold s1; lra).
  assert (Sy : sy <= 2 * (m * k)) by (generalize (product_le _ _ _ _ Bz Cx) (product_le _ _ _ _ Bx Cz); unfold sy; lra).
  assert (Sx : sx <= 2 * (m * k)) by (generalize (product_le _ _ _ _ By_ Cz) (product_le _ _ _ _ Bz Cy); unfold sx; lra).
  assert (P : forall x y, 0 <= Rabs x * Rabs y) by (intros; apply Rmult_le_pos; apply Rabs_pos).
  assert (0 <= s1) by (unfold s1; generalize (P (vx b) (vy c)) (P (vy b) (vx c)); lra).
  assert (0 <= sy) by (unfold sy; generalize (P (vz b) (vx c)) (P (vx b) (vz c)); lra).
  assert (0 <= sx) by (unfold sx; generalize (P (vy b) (vz c)) (P (vz b) (vy c)); lra).
  assert (Rabs (vx a) * sx <= m * (2 * (m * k))) by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (Rabs (vy a) * sy <= m * (2 * (m * k))) by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (Rabs (vz a) * s1 <= k * (2 * (m * m))) by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (M0 : 0 <= mg) by (unfold mg; repeat apply Rplus_le_le_0_compat; apply Rmult_le_pos; auto using Rabs_pos).
  assert (Hmg : mg <= 6 * (m * m * k)) by (unfold mg; lra).
  assert (He : et <= (3 + 4 * m + 2 * k) * eta) by (apply Rmult_le_compat_r; lra).
  assert (0 <= et).
  { apply Rmult_le_pos; [|lra]. generalize (Rabs_pos (vx a)) (Rabs_pos (vy a)) (Rabs_pos (vz a)). lra. }
  assert (Q : (A 5 - 1) * mg <= 6 * u * (6 * (m * m * k))) by (apply Rmult_le_compat; lra).
  assert (Q2 : A 5 * et <= (1 + 6 * u) * ((3 + 4 * m + 2 * k) * eta)) by (apply Rmult_le_compat; lra).
  lra.
Qed.
End Rounded.

(** ** What the errors of the corners move *)

Lemma product_off x y x' y' X Y dx dy : Rabs (x - x') <= dx -> Rabs (y - y') <= dy ->
  Rabs x <= X -> Rabs y' <= Y -> Rabs (x * y - x' * y') <= dx * Y + X * dy.
Proof.
  intros Dx Dy Hx Hy. replace (x * y - x' * y') with ((x - x') * y' + x * (y - y')) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult.
  generalize (product_le _ _ _ _ Dx Hy) (product_le _ _ _ _ Hx Dy). lra.
Qed.

Lemma within_close m k place weight v v' : within m k v -> close place weight v v' ->
  within (m + place) (k + weight) v'.
Proof.
  intros [A1 [A2 A3]] [B1 [B2 B3]].
  assert (T : forall x y d e, Rabs x <= d -> Rabs (x - y) <= e -> Rabs y <= d + e).
  { intros x y d e D E. replace y with (x + - (x - y)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  repeat split; eauto.
Qed.

Lemma edge_moved a b a' b' up right m k place weight r : 0 <= place -> 0 <= weight ->
  within m k a -> within m k b -> close place weight a a' -> close place weight b b' ->
  Rabs up <= r -> Rabs right <= r ->
  let f := m + place in let h := k + weight in
  Rabs (det a b (pixel_ray up right) - det a' b' (pixel_ray up right))
  <= 4 * r * (place * h + f * weight) + 4 * (f * place).
Proof.
  intros P0 W0 Ha Hb Ca Cb U R f h.
  destruct (within_close _ _ _ _ _ _ Hb Cb) as [Bx' [By' Bz']]. fold f h in Bx', By', Bz'.
  destruct Ha as [Ax [Ay Az]], Hb as [Bx [By_ Bz]], Ca as [DAx [DAy DAz]], Cb as [DBx [DBy DBz]].
  assert (m <= f) by (unfold f; lra). assert (k <= h) by (unfold h; lra).
  assert (xy := product_off _ _ _ _ f f _ _ DAx DBy ltac:(lra) By').
  assert (yx := product_off _ _ _ _ f f _ _ DAy DBx ltac:(lra) Bx').
  assert (zx := product_off _ _ _ _ h f _ _ DAz DBx ltac:(lra) Bx').
  assert (xz := product_off _ _ _ _ f h _ _ DAx DBz ltac:(lra) Bz').
  assert (yz := product_off _ _ _ _ f h _ _ DAy DBz ltac:(lra) Bz').
  assert (zy := product_off _ _ _ _ h f _ _ DAz DBy ltac:(lra) By').
  set (d1 := vx a * vy b - vx a' * vy b') in *. set (d2 := vy a * vx b - vy a' * vx b') in *.
  set (d3 := vz a * vx b - vz a' * vx b') in *. set (d4 := vx a * vz b - vx a' * vz b') in *.
  set (d5 := vy a * vz b - vy a' * vz b') in *. set (d6 := vz a * vy b - vz a' * vy b') in *.
  replace (det a b (pixel_ray up right) - det a' b' (pixel_ray up right))
    with (d1 - d2 + ((d3 - d4) * up + (d5 - d6) * right))
    by (unfold d1, d2, d3, d4, d5, d6, det, dot, cross, pixel_ray; simpl; ring).
  eapply Rle_trans; [apply Rabs_triang|].
  assert (S : forall x y X, Rabs x <= X -> Rabs y <= X -> Rabs (x - y) <= 2 * X).
  { intros x y X HX HY. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (E1 := S _ _ (2 * (f * place)) ltac:(eapply Rle_trans; [apply xy | lra]) ltac:(eapply Rle_trans; [apply yx | lra])).
  assert (Ey := S _ _ (place * h + f * weight) ltac:(eapply Rle_trans; [apply zx | lra]) ltac:(eapply Rle_trans; [apply xz | lra])).
  assert (Ex := S _ _ (place * h + f * weight) ltac:(eapply Rle_trans; [apply yz | lra]) ltac:(eapply Rle_trans; [apply zy | lra])).
  assert (Py := product_le _ _ _ _ Ey U). assert (Px := product_le _ _ _ _ Ex R).
  assert (Rabs ((d3 - d4) * up + (d5 - d6) * right) <= 4 * r * (place * h + f * weight)).
  { eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult. lra. }
  lra.
Qed.

Lemma volume_moved a b c a' b' c' m k place weight : 0 <= place -> 0 <= weight ->
  within m k a -> within m k b -> within m k c ->
  close place weight a a' -> close place weight b b' -> close place weight c c' ->
  let f := m + place in let h := k + weight in
  Rabs (det a b c - det a' b' c') <= 6 * f * (2 * (place * h) + f * weight).
Proof.
  intros P0 W0 Ha Hb Hc Ca Cb Cc f h.
  destruct (within_close _ _ _ _ _ _ Hb Cb) as [Bx' [By' Bz']].
  destruct (within_close _ _ _ _ _ _ Hc Cc) as [Cx' [Cy' Cz']]. fold f h in Bx', By', Bz', Cx', Cy', Cz'.
  destruct Ha as [Ax [Ay Az]], Hb as [Bx [By_ Bz]], Hc as [Cx [Cy Cz]],
    Ca as [DAx [DAy DAz]], Cb as [DBx [DBy DBz]], Cc as [DCx [DCy DCz]].
  assert (m <= f) by (unfold f; lra). assert (k <= h) by (unfold h; lra).
  assert (T : forall p q w p' q' w', Rabs (p - p') <= place -> Rabs (q - q') <= place ->
      Rabs (w - w') <= weight -> Rabs p <= m -> Rabs q <= m -> Rabs q' <= f -> Rabs w' <= h ->
      Rabs (p * q * w - p' * q' * w') <= 2 * (place * h * f) + f * f * weight).
  { intros p q w p' q' w' Dp Dq Dw Hp Hq Hq' Hw'.
    assert (I := product_off p q p' q' f f place place Dp Dq ltac:(lra) Hq').
    assert (J : Rabs (p * q) <= f * f) by (rewrite Rabs_mult; apply product_le; lra).
    assert (L := product_off _ w _ w' (f * f) h _ _ I Dw J Hw'). lra. }
  assert (t1 := T _ _ _ _ _ _ DAx DBy DCz Ax By_ By' Cz'). assert (t2 := T _ _ _ _ _ _ DAy DBx DCz Ay Bx Bx' Cz').
  assert (t3 := T _ _ _ _ _ _ DAx DCy DBz Ax Cy Cy' Bz'). assert (t4 := T _ _ _ _ _ _ DAy DCx DBz Ay Cx Cx' Bz').
  assert (W : forall p q w p' q' w', Rabs (p - p') <= place -> Rabs (q - q') <= place ->
      Rabs (w - w') <= weight -> Rabs p <= m -> Rabs q <= m -> Rabs q' <= f -> Rabs p' <= f -> Rabs w <= k ->
      Rabs (p * q * w - p' * q' * w') <= 2 * (place * h * f) + f * f * weight).
  { intros p q w p' q' w' Dp Dq Dw Hp Hq Hq' Hp' Hw.
    assert (I := product_off p q p' q' f f place place Dp Dq ltac:(lra) Hq').
    assert (J : Rabs (p' * q') <= f * f) by (rewrite Rabs_mult; apply product_le; lra).
    replace (p * q * w - p' * q' * w') with (w * (p * q) - w' * (p' * q')) by ring.
    assert (L := product_off w (p * q) w' (p' * q') h (f * f) _ _ Dw I ltac:(lra) J). lra. }
  assert (t5 := W _ _ _ _ _ _ DBx DCy DAz Bx Cy Cy' Bx' Az). assert (t6 := W _ _ _ _ _ _ DBy DCx DAz By_ Cx Cx' By' Az).
  apply Rabs_le_inv in t1, t2, t3, t4, t5, t6.
  apply Rabs_le. unfold det, dot, cross. simpl. lra.
Qed.

(** ** The bounds hold *)

(** What is asked of the inputs. Of the film: the bounds are floats, and not tiny. Of the corners a,
    b, c, relative to the first pixel, as computed: they are off from the exact ones by no more than
    place and weight. That has to include the roundings of p - x0 w itself. Of the box: its size. *)
Record fit (place weight reach : R) (a b c a' b' c' : vec) : Prop := {
  f_place : is_float place; f_weight : is_float weight; f_reach : is_float reach;
  f_a : float_vec a; f_b : float_vec b; f_c : float_vec c;
  pos_place : 0 <= place; pos_weight : 0 <= weight; size_reach : 1 <= reach <= 4294967296;
  not_tiny : bpow radix2 (-1009) <= top a b c + weight;
  place_not_tiny : top a b c + weight <= bpow radix2 60 * place;
  room_a : close place weight a a'; room_b : close place weight b b'; room_c : close place weight c c' }.

Lemma fit_turn place weight reach a b c a' b' c' :
  fit place weight reach a b c a' b' c' -> within (span a b c) (top a b c) a /\
  within (span a b c) (top a b c) b /\ within (span a b c) (top a b c) c /\
  is_float (span a b c) /\ is_float (top a b c) /\ 0 <= span a b c /\ 0 <= top a b c.
Proof.
  intros H. assert (Q : forall x y, x <= Rmax x y /\ y <= Rmax x y) by (intros; split; [apply Rmax_l | apply Rmax_r]).
  unfold within, span, top, largest6.
  assert (L : forall x y z, x <= y -> x <= Rmax y z) by (intros; eapply Rle_trans; [eassumption | apply Rmax_l]).
  assert (F : forall x y, is_float x -> is_float y -> is_float (Rmax x y)).
  { intros x y X Y. unfold Rmax. destruct (Rle_dec x y); auto. }
  destruct (f_a _ _ _ _ _ _ _ _ _ H) as [? [? ?]], (f_b _ _ _ _ _ _ _ _ _ H) as [? [? ?]],
    (f_c _ _ _ _ _ _ _ _ _ H) as [? [? ?]].
  repeat split; try solve [repeat first [apply Rmax_r | apply Rle_refl | apply L]];
    repeat apply F; auto using is_float_abs;
    (eapply Rle_trans; [apply Rabs_pos | repeat first [apply Rmax_r | apply L]]).
Qed.

Section Bound.
Variables (place weight reach : R) (a b c a' b' c' : vec).
Hypothesis ok : fit place weight reach a b c a' b' c'.
Let far := far_of (span a b c) place.
Let high := high_of (top a b c) weight.
Let e_max := edge_error reach place weight far high.
Let t_max := volume_error place weight far high.

Lemma edge_bound_of v w v' w' up right : float_vec v -> float_vec w ->
  within (span a b c) (top a b c) v -> within (span a b c) (top a b c) w ->
  close place weight v v' -> close place weight w w' ->
  is_float up -> is_float right -> Rabs up <= reach -> Rabs right <= reach ->
  Rabs (edge_at v w up right - det v' w' (pixel_ray up right)) <= e_max.
Proof.
  intros Fv Fw Wv Ww Cv Cw Fu Fr U R. destruct ok.
  destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [_ [_ [_ [Fm [Fk [Pm Pk]]]]]].
  eapply Rle_trans; [|apply edge_error_low; auto].
  assert (E1 := edge_rounding v w up right _ _ reach Fv Fw Fu Fr Wv Ww U R).
  assert (E2 := edge_moved v w v' w' up right _ _ place weight reach pos_place0 pos_weight0 Wv Ww Cv Cw U R).
  simpl in E2. set (m := span a b c) in *. set (k := top a b c) in *.
  set (x := edge_at v w up right) in *. set (y := det v w (pixel_ray up right)) in *.
  replace (x - det v' w' (pixel_ray up right)) with ((x - y) + (y - det v' w' (pixel_ray up right))) by ring.
  eapply Rle_trans; [apply Rabs_triang|].
  assert (Q := u_pos). assert (V := u_small). assert (N := eta_pos). assert (Y := tiny_eta).
  assert (m * k <= (m + place) * (k + weight)) by (apply Rmult_le_compat; lra).
  assert (m * m <= (m + place) * (m + place)) by (apply Rmult_le_compat; lra).
  assert (reach * (m * k) <= reach * ((m + place) * (k + weight))) by (apply Rmult_le_compat_l; lra).
  assert (6 * u * (4 * reach * (m * k) + 2 * (m * m))
    <= 6 * u * (4 * reach * ((m + place) * (k + weight)) + 2 * ((m + place) * (m + place))))
    by (apply Rmult_le_compat_l; lra).
  assert ((1 + 6 * u) * (5 + 4 * reach) * eta <= 2 * 17179869200 * eta).
  { apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat; lra. }
  assert (0 <= place * (k + weight)) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * weight) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * place) by (apply Rmult_le_pos; lra).
  assert (0 <= reach * (place * (k + weight) + (m + place) * weight)) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * (k + weight)) by (apply Rmult_le_pos; lra).
  assert (0 <= reach * ((m + place) * (k + weight))) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * (m + place)) by (apply Rmult_le_pos; lra).
  assert (0 <= u * (4 * reach * ((m + place) * (k + weight)) + 2 * ((m + place) * (m + place))))
    by (apply Rmult_le_pos; lra).
  lra.
Qed.

(** An edge function is off by no more than its bound. *)
Theorem edge_bound up right :
  is_float up -> is_float right -> Rabs up <= reach -> Rabs right <= reach ->
  Rabs (edge_at b c up right - det b' c' (pixel_ray up right)) <= e_max /\
  Rabs (edge_at c a up right - det c' a' (pixel_ray up right)) <= e_max /\
  Rabs (edge_at a b up right - det a' b' (pixel_ray up right)) <= e_max.
Proof.
  intros. destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [Wa [Wb [Wc _]]]. destruct ok.
  repeat split; now apply edge_bound_of.
Qed.

(** T is off by no more than its bound. *)
Theorem volume_bound : Rabs (volume a b c - det a' b' c') <= t_max.
Proof.
  destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [Wa [Wb [Wc [Fm [Fk [Pm Pk]]]]]]. destruct ok.
  assert (E1 := volume_rounding a b c _ _ f_a0 f_b0 f_c0 Wa Wb Wc).
  assert (E2 := volume_moved a b c a' b' c' _ _ place weight pos_place0 pos_weight0 Wa Wb Wc room_a0 room_b0 room_c0).
  simpl in E2.
  eapply Rle_trans; [|apply volume_error_low; auto].
  assert (Ef := eta_far (span a b c) (top a b c) place weight Pm Pk pos_place0 pos_weight0 not_tiny0).
  assert (Eh := eta_high (span a b c) (top a b c) place weight Pm Pk pos_place0 pos_weight0 place_not_tiny0).
  set (m := span a b c) in *. set (k := top a b c) in *.
  replace (volume a b c - det a' b' c') with ((volume a b c - det a b c) + (det a b c - det a' b' c')) by ring.
  eapply Rle_trans; [apply Rabs_triang|].
  assert (Q := u_pos). assert (V := u_small). assert (N := eta_pos). assert (Y := tiny_eta).
  assert (m * m <= (m + place) * (m + place)) by (apply Rmult_le_compat; lra).
  assert (m * m * k <= (m + place) * (m + place) * (k + weight))
    by (apply Rmult_le_compat; try lra; apply Rmult_le_pos; lra).
  assert (u * (m * m * k) <= u * ((m + place) * (m + place) * (k + weight))) by (apply Rmult_le_compat_l; lra).
  assert (eta * m <= eta * (m + place)) by (apply Rmult_le_compat_l; lra).
  assert (eta * k <= eta * (k + weight)) by (apply Rmult_le_compat_l; lra).
  assert (0 <= (3 + 4 * m + 2 * k) * eta) by (apply Rmult_le_pos; lra).
  assert ((1 + 6 * u) * ((3 + 4 * m + 2 * k) * eta) <= 2 * ((3 + 4 * m + 2 * k) * eta))
    by (apply Rmult_le_compat_r; lra).
  assert (0 <= place * (k + weight)) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * weight) by (apply Rmult_le_pos; lra).
  assert (0 <= (m + place) * (2 * (place * (k + weight)) + (m + place) * weight)) by (apply Rmult_le_pos; lra).
  assert (0 <= m * k) by (apply Rmult_le_pos; lra).
  assert (0 <= m * m * k) by (apply Rmult_le_pos; [apply Rmult_le_pos; lra | lra]).
  lra.
Qed.

(** ** What that proves of a pixel *)

Variables up right : R.
Hypothesis f_up : is_float up. Hypothesis f_right : is_float right.
Hypothesis in_up : Rabs up <= reach. Hypothesis in_right : Rabs right <= reach.
Let d := pixel_ray up right.

Lemma sure_sign s x x' e : s = 1 \/ s = -1 -> Rabs (x - x') <= e ->
  (s * x < - e -> s * x' < 0) /\ (s * x > e -> s * x' > 0).
Proof. intros [-> | ->] H; apply Rabs_le_inv in H; split; lra. Qed.

(** T is sure: its sign is that of the exact one. *)
Theorem sure_volume : Rabs (volume a b c) > t_max -> sign_of (volume a b c) * det a' b' c' > 0.
Proof.
  assert (E := volume_bound). unfold sign_of. apply Rabs_le_inv in E.
  destruct (Rlt_bool_spec (volume a b c) 0) as [H|H].
  - rewrite Rabs_left by easy. lra.
  - rewrite Rabs_pos_eq by easy. lra.
Qed.

Lemma sign_cases x : sign_of x = 1 \/ sign_of x = -1.
Proof. unfold sign_of. destruct (Rlt_bool x 0); auto. Qed.

(** What is below -E is negative, exactly. *)
Theorem sure_outside s : s = 1 \/ s = -1 ->
  (signed_edge s b c up right < - e_max -> s * det b' c' d < 0) /\
  (signed_edge s c a up right < - e_max -> s * det c' a' d < 0) /\
  (signed_edge s a b up right < - e_max -> s * det a' b' d < 0).
Proof.
  intros S. rewrite !signed_edge_sign by easy. destruct (edge_bound up right) as [E1 [E2 E3]]; auto.
  repeat split; now apply sure_sign.
Qed.

(** If all are above E, and T is sure, the exact ones all have the sign of the exact T; so no edge
    and no plane of the triangle is met edge-on, and the sum, which D is a multiple of, is not 0. *)
Theorem sure_inside : let s := sign_of (volume a b c) in let T := det a' b' c' in
  Rabs (volume a b c) > t_max ->
  signed_edge s b c up right > e_max -> signed_edge s c a up right > e_max ->
  signed_edge s a b up right > e_max ->
  T <> 0 /\ T * det b' c' d > 0 /\ T * det c' a' d > 0 /\ T * det a' b' d > 0 /\
  T * (det b' c' d + det c' a' d + det a' b' d) > 0.
Proof.
  intros s T Sure. assert (P := sure_volume Sure). fold s T in P.
  assert (S : s = 1 \/ s = -1) by apply sign_cases.
  rewrite !signed_edge_sign by easy. destruct (edge_bound up right) as [E1 [E2 E3]]; auto. fold d in E1, E2, E3.
  intros H1 H2 H3. apply (sure_sign s) in E1, E2, E3; auto.
  destruct E1 as [_ E1], E2 as [_ E2], E3 as [_ E3]. specialize (E1 H1). specialize (E2 H2). specialize (E3 H3).
  assert (K : forall x, s * x > 0 -> T * x > 0) by (intros x; destruct S as [E|E]; rewrite E in *; nra).
  repeat split; auto. 1: { intros Z. rewrite Z in P. lra. }
  generalize (K _ E1) (K _ E2) (K _ E3). lra.
Qed.

(** A pixel is dropped where the least of the three is below -E. If T is sure, no ray is lost that
    meets the triangle before the eye, that is, with all e of the sign of T or 0. *)
Theorem nothing_lost : let s := sign_of (volume a b c) in let T := det a' b' c' in
  Rabs (volume a b c) > t_max ->
  Rmin (Rmin (signed_edge s b c up right) (signed_edge s c a up right)) (signed_edge s a b up right) < - e_max ->
  ~ (0 <= T * det b' c' d /\ 0 <= T * det c' a' d /\ 0 <= T * det a' b' d).
Proof.
  intros s T Sure. assert (P := sure_volume Sure). fold s T in P.
  assert (S : s = 1 \/ s = -1) by apply sign_cases.
  destruct (sure_outside s S) as [O1 [O2 O3]]. intros L [H1 [H2 H3]].
  assert (K : forall x, s * x < 0 -> 0 <= T * x -> False) by (intros x; destruct S as [E|E]; rewrite E in *; nra).
  revert L. apply Rmin_case; [apply Rmin_case|]; eauto.
Qed.

(** If it is not, there are two set-ups, one for each sign. A pixel that both drop has exact edge
    functions of both signs: the line of its ray does not meet the triangle. *)
Theorem nothing_lost_unsure :
  let least s := Rmin (Rmin (signed_edge s b c up right) (signed_edge s c a up right)) (signed_edge s a b up right) in
  least 1 < - e_max -> least (-1) < - e_max ->
  ~ (0 <= det b' c' d /\ 0 <= det c' a' d /\ 0 <= det a' b' d) /\
  ~ (det b' c' d <= 0 /\ det c' a' d <= 0 /\ det a' b' d <= 0).
Proof.
  intros least L1 L2.
  destruct (sure_outside 1) as [O1 [O2 O3]]; [now left|].
  destruct (sure_outside (-1)) as [O4 [O5 O6]]; [now right|].
  split; intros [H1 [H2 H3]].
  - revert L1. unfold least. apply Rmin_case; [apply Rmin_case|]; intros L;
      [specialize (O1 L) | specialize (O2 L) | specialize (O3 L)]; lra.
  - revert L2. unfold least. apply Rmin_case; [apply Rmin_case|]; intros L;
      [specialize (O4 L) | specialize (O5 L) | specialize (O6 L)]; lra.
Qed.
End Bound.

(** Counting from another pixel changes no determinant: with p - x0 w and q - y0 w in place of p and
    q, and the pixel counted from there as well, they are the same. *)
Definition moved (x0 y0 : R) (v : vec) : vec := V (vx v - x0 * vz v) (vy v - y0 * vz v) (vz v).
Lemma moved_det x0 y0 a b x y :
  det (moved x0 y0 a) (moved x0 y0 b) (pixel_ray (y - y0) (x - x0)) = det a b (V x y 1).
Proof. unfold det, dot, cross, moved, pixel_ray. simpl. ring. Qed.
Lemma moved_volume x0 y0 a b c : det (moved x0 y0 a) (moved x0 y0 b) (moved x0 y0 c) = det a b c.
Proof. unfold det, dot, cross, moved. simpl. ring. Qed.

(** So what is asked of a corner v as it is stored, and of v' exactly, is this. *)
Definition room_in_place (place weight x0 y0 : R) (v v' : vec) : Prop :=
  close place weight (relative x0 y0 v) (moved x0 y0 v').
