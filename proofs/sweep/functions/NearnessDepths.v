(** How near a triangle is, of parallel rays: the function that edge_functions.py makes of the depths of
    its corners, and how far rounding takes it from the one without.

    See "A triangle as four linear functions of the pixel" in docs/speed.md. The formulas, and what is
    common to both projections, are in NearnessCommon.v and NearnessPixel.v; the bound is in NearnessParallel.v. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding EdgeFunctions NearnessCommon NearnessPixel.
Open Scope R_scope.
Local Opaque u eta.

(** The depths of the corners as computed, and exactly; [own] bounds how far they are apart, is larger
    than a few roundings of them, and not tiny. All w are 1, so the three e sum up to T. The stored
    ray's t is the mean of the exact depths, with the weights e / T. *)
Class depths {given : sure_pixel} := Depths {
  da : R; db : R; dc : R; own : R; da' : R; db' : R; dc' : R;
  f_da : is_float da; f_db : is_float db; f_dc : is_float dc; f_own : is_float own;
  own_a : Rabs (da - da') <= own; own_b : Rabs (db - db') <= own; own_c : Rabs (dc - dc') <= own;
  rounds_a : 16 * u * Rabs da <= own;
  rounds_b : 16 * u * Rabs db <= own;
  rounds_c : 16 * u * Rabs dc <= own;
  own_not_tiny : bpow radix2 (-900) <= own;
  w_is_1 : vz a = 1 /\ vz a' = 1 /\ vz b' = 1 /\ vz c' = 1
}.

Section Near.
Context {given : sure_pixel} {of_corners : depths}.
Definition bb := rnd (db - da).
Definition cc := rnd (dc - da).
Definition B := Rmax (Rabs bb) (Rabs cc).
Definition value := near_parallel a b c up right da db dc.

Lemma amount_not_tiny : bpow radix2 (-120) <= amount.
Proof.
  destruct nonneg as [_ [_ [_ [F0 H0]]]].
  destruct (fit_turn _ _ _ _ _ _ _ _ _ ok) as [[_ [_ Wz]] [_ [_ [Fm [Fk [Pm Pk]]]]]].
  assert (S := sure). destruct ok. destruct w_is_1 as [W _]. rewrite W, Rabs_R1 in Wz.
  assert (L := volume_error_low _ _ _ _ Fm Fk f_place f_weight Pm Pk pos_place pos_weight not_tiny
    place_not_tiny).
  fold far high t_max in L. fold f h in L. assert (U := u_pos).
  assert (Bt := bpow_gt_0 radix2 (-1000)). fold tiny in Bt.
  assert (h1 : 1 <= h) by (unfold h; lra).
  assert (p : bpow radix2 (-60) <= place).
  { apply (Rmult_le_reg_l (bpow radix2 60)); [apply bpow_gt_0|]. rewrite <- bpow_plus.
    change (bpow radix2 (60 + -60)) with 1. fold h in place_not_tiny. lra. }
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
  assert (Ra := rounds_a). assert (Ot := own_not_tiny).
  assert (M1 : Rabs bb <= B) by apply Rmax_l. assert (M2 : Rabs cc <= B) by apply Rmax_r.
  assert (K : forall x, is_float x -> 16 * u * Rabs x <= own ->
    Rabs (rnd (x - da) - (x - da)) <= own / 8 /\ u * Rabs (rnd (x - da)) <= 0.126 * own).
  { intros x F R. assert (E := rnd_err_sum x (- da) F (is_float_opp _ f_da)).
    change (x + - da) with (x - da) in E.
    assert (T1 : Rabs (x - da) <= Rabs x + Rabs da).
    { unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
    assert (T2 : u * Rabs (x - da) <= u * (Rabs x + Rabs da)) by (apply Rmult_le_compat_l; lra).
    split; [lra|].
    assert (T3 : Rabs (rnd (x - da)) <= (1 + u) * Rabs (x - da)).
    { replace (rnd (x - da)) with ((rnd (x - da) - (x - da)) + (x - da)) by ring.
      eapply Rle_trans; [apply Rabs_triang|]. lra. }
    assert (T4 : u * Rabs (rnd (x - da)) <= u * ((1 + u) * Rabs (x - da))) by (apply Rmult_le_compat_l; lra).
    assert (u * (u * Rabs (x - da)) <= 0.0001 * (u * Rabs (x - da))) by (apply Rmult_le_compat_r; [|lra];
      apply Rmult_le_pos; [lra | apply Rabs_pos]).
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
    assert (H : Rabs (w - z / - amount) * amount <= (u * Rabs (z / - amount) + eta) * amount)
      by (apply Rmult_le_compat_r; lra).
    replace (Rabs (z / - amount)) with (Rabs z / amount) in H.
    2: { unfold Rdiv. rewrite Rabs_mult, Rinv_opp, Rabs_Ropp, (Rabs_pos_eq (/ amount)) by (try lra;
      apply Rlt_le, Rinv_0_lt_compat; lra). easy. }
    replace ((u * (Rabs z / amount) + eta) * amount) with (u * Rabs z + eta * amount) in H by (field; lra).
    easy. }
  set (S := (Rabs f1 + Rabs f2) * B).
  assert (P1 : Rabs (f1 * bb) <= Rabs f1 * B) by (rewrite Rabs_mult; apply Rmult_le_compat_l;
    [apply Rabs_pos | easy]).
  assert (P2 : Rabs (f2 * cc) <= Rabs f2 * B) by (rewrite Rabs_mult; apply Rmult_le_compat_l;
    [apply Rabs_pos | easy]).
  assert (PS : Rabs (f1 * bb) + Rabs (f2 * cc) <= S) by (unfold S; lra).
  assert (S0 : 0 <= S) by (generalize (Rabs_pos (f1 * bb)) (Rabs_pos (f2 * cc)); lra).
  assert (US : 0 <= u * S <= 0.0001 * S) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
  assert (Ue : 0 <= u * eta <= 0.0001 * eta) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r;
    lra]).
  assert (UP : u * (Rabs (f1 * bb) + Rabs (f2 * cc)) <= u * S) by (apply Rmult_le_compat_l; lra).
  assert (B2 : Rabs (x + y) <= 1.0001 * S + 2 * eta).
  { replace (x + y) with ((x - f1 * bb) + (y - f2 * cc) + (f1 * bb + f2 * cc)) by ring.
    eapply Rle_trans; [apply Rabs_triang|].
    generalize (Rabs_triang (x - f1 * bb) (y - f2 * cc)) (Rabs_triang (f1 * bb) (f2 * cc)). lra. }
  assert (UB : u * Rabs (x + y) <= u * (1.0001 * S + 2 * eta)) by (apply Rmult_le_compat_l; lra).
  assert (B3 : Rabs z <= 1.0003 * S + 3 * eta).
  { replace z with ((z - (x + y)) + (x + y)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (UZ : u * Rabs z <= u * (1.0003 * S + 3 * eta)) by (apply Rmult_le_compat_l; lra).
  apply Rabs_le_inv in E1, E2, E3, Q. apply Rabs_le. lra.
Qed.

Lemma near_parallel_off :
  Rabs ((value + da) * amount + s * (linear c a * bb + linear a b * cc))
  <= 7.01 * ((2.002 * Y + 2 * slack) * B) + 4.01 * (u * Rabs da) * amount + 10 * (reach * eta)
    + 8 * (reach * eta) * amount.
Proof.
  destruct three as [_ [_ [_ [S2 [_ S3]]]]]. destruct slack_tiny as [K0 K1].
  destruct amount_pos as [A0 _]. destruct nonneg as [_ [Y0 [R1 _]]].
  assert (U := u_small). assert (P := u_pos). assert (N := eta_pos). destruct B_facts as [_ [_ [B0 _]]].
  assert (O : forall of, (forall v w, is_float (of v w)) -> Rabs (coefficient_p a b c da db dc of * amount + s * (of c a * bb
    + of a b * cc))
    <= 3.001 * (u * ((Rabs (of c a) + Rabs (of a b)) * B)) + 3 * eta + eta * amount /\
    Rabs (coefficient_p a b c da db dc of) * amount <= 1.0001 * ((Rabs (of c a) + Rabs (of a b)) * B) + 3 * eta
      + eta * amount).
  { intros of F.
    change (coefficient_p a b c da db dc of)
      with (mixed amount (rnd (of c a * s)) (rnd (of a b * s)) bb cc).
    destruct (signed _ (F c a)) as [-> B2], (signed _ (F a b)) as [-> B3].
    assert (H := mixed_off (of c a * s) (of a b * s)). rewrite B2, B3 in H.
    set (g := mixed amount (of c a * s) (of a b * s) bb cc) in *.
    set (S := (Rabs (of c a) + Rabs (of a b)) * B) in *.
    assert (S0 : 0 <= S) by (unfold S; pos).
    replace (of c a * s * bb + of a b * s * cc) with (s * (of c a * bb + of a b * cc)) in H by ring.
    split; [easy|].
    destruct B_facts as [Bb [Bc _]].
    assert (Q : Rabs (s * (of c a * bb + of a b * cc)) <= S).
    { replace (s * (of c a * bb + of a b * cc)) with (of c a * s * bb + of a b * s * cc) by ring.
      eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_mult _ bb), (Rabs_mult _ cc), B2, B3.
      assert (Rabs (of c a) * Rabs bb <= Rabs (of c a) * B) by (apply Rmult_le_compat_l;
        [apply Rabs_pos | easy]).
      assert (Rabs (of a b) * Rabs cc <= Rabs (of a b) * B) by (apply Rmult_le_compat_l;
        [apply Rabs_pos | easy]). unfold S. lra. }
    assert (u * S <= 0.00001 * S) by (apply Rmult_le_compat_r; lra).
    rewrite <- (Rabs_pos_eq amount) at 1 by lra. rewrite <- Rabs_mult.
    set (m := s * (of c a * bb + of a b * cc)) in *.
    replace (g * amount) with ((g * amount + m) + - m) by ring. eapply Rle_trans; [apply Rabs_triang|].
    rewrite Rabs_Ropp. lra. }
  destruct (O of_1 ltac:(intros; apply rnd_float)) as [O1 Z1].
  destruct (O of_y ltac:(intros; apply rnd_float)) as [Oy Zy].
  destruct (O of_x ltac:(intros; apply rnd_float)) as [Ox Zx]. clear O.
  assert (AP := at_pixel_off (rnd (coefficient_p a b c da db dc of_1 - da)) (coefficient_p a b c da db dc of_y) (coefficient_p a b c da db dc of_x) up
    right reach (rnd_float _) in_up in_right).
  change (at_pixel _ _ _ up right) with value in AP.
  assert (E0 := rnd_err_sum (coefficient_p a b c da db dc of_1) (- da) (rnd_float _) (is_float_opp _ f_da)).
  change (coefficient_p a b c da db dc of_1 + - da) with (coefficient_p a b c da db dc of_1 - da) in E0.
  set (n1 := coefficient_p a b c da db dc of_1) in *. set (ny := coefficient_p a b c da db dc of_y) in *.
  set (nx := coefficient_p a b c da db dc of_x) in *.
  set (s1 := (Rabs (of_1 c a) + Rabs (of_1 a b)) * B) in *.
  set (sy := (Rabs (of_y c a) + Rabs (of_y a b)) * B) in *.
  set (sx := (Rabs (of_x c a) + Rabs (of_x a b)) * B) in *.
  assert (SG : u * (s1 + reach * sy + reach * sx) <= (2.002 * Y + 2 * slack) * B).
  { replace (u * (s1 + reach * sy + reach * sx)) with ((u * sizes c a + u * sizes a b) * B)
      by (unfold sizes, s1, sy, sx; ring).
    apply Rmult_le_compat_r; lra. }
  assert (s1p : 0 <= s1) by (unfold s1; pos). assert (syp : 0 <= sy) by (unfold sy; pos).
  assert (sxp : 0 <= sx) by (unfold sx; pos).
  assert (ry : 0 <= reach * sy) by pos. assert (rx : 0 <= reach * sx) by pos.
  assert (SG0 : 0 <= u * (s1 + reach * sy + reach * sx)) by (apply Rmult_le_pos; lra).
  assert (D0 : Rabs (n1 - da) <= Rabs n1 + Rabs da) by (unfold Rminus; eapply Rle_trans; [apply Rabs_triang|];
    rewrite Rabs_Ropp; lra).
  assert (D1 : u * Rabs (n1 - da) <= u * (Rabs n1 + Rabs da)) by (apply Rmult_le_compat_l; lra).
  set (g1 := rnd (n1 - da)) in *.
  assert (D2 : Rabs g1 <= 1.0001 * (Rabs n1 + Rabs da)).
  { replace g1 with ((g1 - (n1 - da)) + (n1 - da)) by ring. eapply Rle_trans; [apply Rabs_triang|].
    assert (u * (Rabs n1 + Rabs da) <= 0.0001 * (Rabs n1 + Rabs da)) by (apply Rmult_le_compat_r;
      [pos | lra]). lra. }
  set (t := Rabs n1 + reach * Rabs ny + reach * Rabs nx).
  assert (AP2 : Rabs (value - (n1 - da + ny * up + nx * right)) <= 4.002 * (u * t) + 4.002 * (u * Rabs
    da) + 3 * eta).
  { assert (u * (Rabs g1 + reach * Rabs ny + reach * Rabs nx) <= u * (1.0001 * (Rabs n1 + Rabs da)
      + reach * Rabs ny + reach * Rabs nx))
      by (apply Rmult_le_compat_l; lra).
    assert (0 <= u * (reach * Rabs ny)) by (repeat (apply Rmult_le_pos; [lra|]); apply Rabs_pos).
    assert (0 <= u * (reach * Rabs nx)) by (repeat (apply Rmult_le_pos; [lra|]); apply Rabs_pos).
    assert (0 <= u * Rabs n1 /\ 0 <= u * Rabs da) by (split; apply Rmult_le_pos; try lra; apply Rabs_pos).
    replace (value - (n1 - da + ny * up + nx * right)) with ((value - (g1 + ny * up
      + nx * right)) + (g1 - (n1 - da))) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. unfold t. lra. }
  assert (EA : 0 <= eta * amount) by pos.
  assert (ER : eta * amount <= reach * (eta * amount)) by (rewrite <- (Rmult_1_l (eta * amount)) at 1;
    apply Rmult_le_compat_r; lra).
  assert (EE : eta <= reach * eta) by (rewrite <- (Rmult_1_l eta) at 1; apply Rmult_le_compat_r; lra).
  assert (Tm : t * amount <= 1.0001 * (s1 + reach * sy + reach * sx) + 9 * (reach * eta)
    + 3 * (reach * (eta * amount))).
  { assert (reach * (Rabs ny * amount) <= reach * (1.0001 * sy + 3 * eta + eta * amount))
      by (apply Rmult_le_compat_l; lra).
    assert (reach * (Rabs nx * amount) <= reach * (1.0001 * sx + 3 * eta + eta * amount))
      by (apply Rmult_le_compat_l; lra).
    unfold t. lra. }
  assert (UT : u * (t * amount) <= u * (1.0001 * (s1 + reach * sy + reach * sx) + 9 * (reach * eta)
    + 3 * (reach * (eta * amount))))
    by (apply Rmult_le_compat_l; lra).
  assert (0 <= u * (reach * eta) <= 0.00001 * (reach * eta)) by (split; [apply Rmult_le_pos;
    lra | apply Rmult_le_compat_r; lra]).
  assert (0 <= u * (reach * (eta * amount)) <= 0.00001 * (reach * (eta * amount))) by (split;
    [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
  assert (G3 : Rabs ((value - (n1 - da + ny * up + nx * right)) * amount)
    <= (4.002 * (u * t) + 4.002 * (u * Rabs da) + 3 * eta) * amount).
  { rewrite Rabs_mult, (Rabs_pos_eq amount) by lra. apply Rmult_le_compat_r; lra. }
  assert (G1 := product_le _ _ _ _ Oy in_up). assert (G2 := product_le _ _ _ _ Ox in_right).
  rewrite <- Rabs_mult in G1, G2.
  set (x1 := n1 * amount + s * (of_1 c a * bb + of_1 a b * cc)) in *.
  set (xy := (ny * amount + s * (of_y c a * bb + of_y a b * cc)) * up) in *.
  set (xx := (nx * amount + s * (of_x c a * bb + of_x a b * cc)) * right) in *.
  set (xp := (value - (n1 - da + ny * up + nx * right)) * amount) in *.
  replace ((value + da) * amount + s * (linear c a * bb + linear a b * cc)) with (xp + x1 + xy + xx)
    by (unfold xp, x1, xy, xx, linear; ring).
  assert (0 <= u * Rabs da * amount) by (apply Rmult_le_pos; [apply Rmult_le_pos; [lra | apply Rabs_pos] |
    lra]).
  assert (V1 := Rabs_triang xp x1). assert (V2 := Rabs_triang (xp + x1) xy).
  eapply Rle_trans; [apply Rabs_triang|].
  eapply Rle_trans; [apply Rplus_le_compat; [eapply Rle_trans; [exact V2|]; apply Rplus_le_compat;
    [eapply Rle_trans; [exact V1 | apply Rplus_le_compat; eassumption]|]|]; eassumption|].
  clear V1 V2. lra.
Qed.
End Near.
