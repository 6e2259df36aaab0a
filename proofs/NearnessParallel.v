(** How near a triangle is, of parallel rays: -t of the ray, and the bound on what rounding does to it.

    See "A triangle as four linear functions of the pixel" in docs/speed.md. The formulas, and what is
    common to both projections, are in NearnessCommon.v, what is made of the depths in
    NearnessDepths.v. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding EdgeFunctions NearnessCommon NearnessDepths.
Open Scope R_scope.
Local Opaque u eta.

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
Local Notation linear := (NearnessCommon.linear up right).
Local Notation sizes := (NearnessCommon.sizes reach).
Let slack := 20 * (reach * eta).

(** What NearnessCommon.v says of these. *)
Let nonneg : 0 <= X /\ 0 <= Y /\ 1 <= reach <= 4294967296 /\ 0 <= f /\ 0 <= h.
Proof. now apply (NearnessCommon.nonneg place weight reach a b c a' b' c'). Qed.
Let unit_low : X + 8 * Y + 4/10 * tiny <= e_max.
Proof. now apply (NearnessCommon.unit_low place weight reach a b c a' b' c'). Qed.
Let T_sign : Rabs (amount - s * T) <= t_max /\ s * T > 0 /\ 1/2 * tiny <= t_max.
Proof. now apply (NearnessCommon.T_sign place weight reach a b c a' b' c'). Qed.
Let three : Rabs (linear b c - e_bc) <= X + 2.001 * Y + slack /\ u * sizes b c <= 1.001 * Y + slack /\
  Rabs (linear c a - e_ca) <= X + 2.001 * Y + slack /\ u * sizes c a <= 1.001 * Y + slack /\
  Rabs (linear a b - e_ab) <= X + 2.001 * Y + slack /\ u * sizes a b <= 1.001 * Y + slack.
Proof. now apply (NearnessCommon.three place weight reach a b c a' b' c' ok up right). Qed.
Let slack_tiny : 0 <= slack <= 1e-9 * tiny.
Proof. now apply (NearnessCommon.slack_tiny place weight reach a b c a' b' c'). Qed.
Let over_least v : 0 <= v -> 0.9999 * (v / amount) <= v / rnd (amount - t_max).
Proof. now apply (NearnessCommon.over_least place weight reach a b c a' b' c'). Qed.
Let amount_pos : 0 < amount /\ 0 <= t_max /\ 0 < e_max.
Proof. now apply (NearnessCommon.amount_pos place weight reach a b c a' b' c'). Qed.


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
Let B := Rmax (Rabs bb) (Rabs cc).
Local Notation near_parallel := (NearnessDepths.near_parallel a b c up right da db dc).

(** What NearnessDepths.v says of these. *)
Let amount_not_tiny : bpow radix2 (-120) <= amount.
Proof. now apply (NearnessDepths.amount_not_tiny place weight reach a b c a' b' c'). Qed.
Let B_facts : Rabs bb <= B /\ Rabs cc <= B /\ 0 <= B /\ u * B <= 0.126 * own /\
  Rabs (bb - (db - da)) <= own / 8 /\ Rabs (cc - (dc - da)) <= own / 8 /\ 0 < own.
Proof. now apply NearnessDepths.B_facts. Qed.
Let near_parallel_off :
  Rabs ((near_parallel + da) * amount + s * (linear c a * bb + linear a b * cc))
  <= 7.01 * ((2.002 * Y + 2 * slack) * B) + 4.01 * (u * Rabs da) * amount + 10 * (reach * eta)
    + 8 * (reach * eta) * amount.
Proof. eapply (NearnessDepths.near_parallel_off place weight reach a b c a' b' c'); eassumption. Qed.

Lemma reach_eta : reach * eta <= own / 1000 /\ 10 * (reach * eta) <= own / 100 * amount.
Proof.
  destruct nonneg as [_ [_ [R1 _]]]. assert (N := eta_pos). assert (A0 := amount_not_tiny).
  assert (H : reach * eta <= bpow radix2 32 * bpow radix2 (-1074)).
  { assert (E : eta = / 2 * bpow radix2 (-1074)) by reflexivity. change (bpow radix2 32) with 4294967296.
    generalize (bpow_gt_0 radix2 (-1074)). intros. apply Rmult_le_compat; lra. }
  rewrite <- bpow_plus in H. simpl Z.add in H.
  assert (L : forall n, (n <= -20)%Z -> bpow radix2 n <= / 1000000).
  { intros n Hn. assert (bpow radix2 n <= bpow radix2 (-20)) by (apply bpow_le; lia).
    simpl (bpow radix2 (-20)) in *. lra. }
  assert (K : bpow radix2 (-900) * bpow radix2 (-120) <= own * amount) by (apply Rmult_le_compat;
    try apply bpow_ge_0; easy).
  rewrite <- bpow_plus in K. simpl Z.add in K.
  assert (bpow radix2 (-1042) <= / 1000000 * bpow radix2 (-1020)).
  { change (-1042)%Z with (-22 + -1020)%Z. rewrite bpow_plus.
    apply Rmult_le_compat_r; [apply bpow_ge_0 | apply L; lia]. }
  assert (bpow radix2 (-1042) <= / 1000000 * bpow radix2 (-900)).
  { change (-1042)%Z with (-142 + -900)%Z. rewrite bpow_plus.
    apply Rmult_le_compat_r; [apply bpow_ge_0 | apply L; lia]. }
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
  unfold la, lb, lc. replace (e_bc / T + e_ca / T + e_ab / T) with ((e_bc + e_ca + e_ab) / T) by (field;
    exact Tn).
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
  { intros e l H G. replace (s * l - e / T * amount) with (s * (l - e) + - (e / T * (amount - s * T)))
      by (field; exact Tn).
    eapply Rle_trans; [apply Rabs_triang|].
    rewrite Rabs_Ropp, (Rabs_mult (e / T)), (Rabs_pos_eq (e / T)) by lra.
    assert (e / T * Rabs (amount - s * T) <= 1 * t_max) by (apply Rmult_le_compat; try lra; apply Rabs_pos).
    assert (Rabs (s * (l - e)) = Rabs (l - e)).
    { rewrite Rabs_mult. destruct (sign_cases (volume a b c)) as [E|E]; unfold s; rewrite E; unfold Rabs at 1;
        destruct Rcase_abs; lra. }
    lra. }
  assert (W2 := W _ _ L2 ltac:(fold lb; lra)). assert (W3 := W _ _ L3 ltac:(fold lc; lra)). fold lb in W2.
  fold lc in W3.
  assert (P2 := product_le _ _ _ _ W2 Bb). assert (P3 := product_le _ _ _ _ W3 Bc).
  rewrite <- Rabs_mult in P2, P3.
  assert (D : Rabs (near_parallel + da + lb * bb + lc * cc)
    <= 2.3 * ((e_max / amount + t_max / amount) * B) + 4.01 * (u * Rabs da) + own / 100 + 8 * (reach * eta)).
  { apply (Rmult_le_reg_r amount); [easy|]. rewrite <- (Rabs_pos_eq amount) at 1 by lra. rewrite <- Rabs_mult.
    replace ((2.3 * ((e_max / amount + t_max / amount) * B) + 4.01 * (u * Rabs da) + own / 100
      + 8 * (reach * eta)) * amount)
      with (2.3 * ((e_max + t_max) * B) + 4.01 * (u * Rabs da) * amount + own / 100 * amount
        + 8 * (reach * eta) * amount) by (field; lra).
    set (p2 := (s * linear c a - lb * amount) * bb) in *.
    set (p3 := (s * linear a b - lc * amount) * cc) in *.
    set (o := (near_parallel + da) * amount + s * (linear c a * bb + linear a b * cc)) in *.
    replace ((near_parallel + da + lb * bb + lc * cc) * amount) with (o + - p2 + - p3) by (unfold o, p2, p3;
      ring).
    assert (V := Rabs_triang (o + - p2) (- p3)). assert (V2 := Rabs_triang o (- p2)).
    rewrite Rabs_Ropp in V, V2.
    assert (M : (2 * X + 18.05 * Y + 17 * slack + 2 * t_max) * B <= 2.3 * (e_max + t_max) * B)
      by (apply Rmult_le_compat_r; lra).
    assert (0 <= Y * B) by (apply Rmult_le_pos; lra). assert (0 <= slack * B) by (apply Rmult_le_pos; lra).
    lra. }
  assert (G2 := scaled_off lb _ _ _ Lb Db). assert (G3 := scaled_off lc _ _ _ Lc Dc).
  assert (H1 := scaled_off la _ _ _ La own_a). assert (H2 := scaled_off lb _ _ _ Lb own_b).
  assert (H3 := scaled_off lc _ _ _ Lc own_c).
  assert (Et : t = la * da' + lb * db' + lc * dc') by (unfold t, la, lb, lc; field; exact Tn).
  assert (Ea : la = 1 - lb - lc) by lra. clear - Et Ea H1 H2 H3 G2 G3 D rounds_a Re Op La Lb Lc L1.
  rewrite Ea in *. apply Rabs_le_inv in D. apply Rabs_le.
  assert (lb * own + lc * own <= own) by (assert (0 <= (1 - lb - lc) * own) by (apply Rmult_le_pos; lra);
    lra).
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
  { rewrite Ex. unfold Rdiv. assert (0.9997 * (6 * (e_max + t_max)) * / amount <= rnd (6 * both) * / amount);
      [|lra].
    apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra | lra]. }
  assert (s4 := low (rnd (6 * both) / least) ltac:(lra)).
  assert (s5 := rnd_pos (rnd (6 * both) / least) ltac:(lra)).
  set (v := rnd (rnd (6 * both) / least)) in *.
  assert (F2 : is_float (2 * own)) by (rewrite <- rnd_2 by easy; apply rnd_float).
  assert (F4 : is_float (4 * own)) by (rewrite <- rnd_4 by easy; apply rnd_float).
  assert (FB : is_float B) by (unfold B; apply Rmax_case; apply is_float_abs, rnd_float).
  assert (t0 := low_sum B (2 * own) FB F2 ltac:(lra)). set (g := rnd (B + 2 * own)) in *.
  assert (t1 : (0.9995 * (6 * ex) - eta) * (0.9999 * B) <= v * (0.9999 * B)) by (apply Rmult_le_compat_r;
    lra).
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
  { split; [apply Rmult_le_pos; lra|]. assert (eta * B <= 1/1000 * u * B) by (apply Rmult_le_compat_r;
      [lra | exact eta_u]). lra. }
  assert (xB : 0 <= ex * B) by (apply Rmult_le_pos; lra).
  assert (Er : 6 * (ex * B) + 4 * own - own / 100 <= er) by lra.
  (* the last rounding *)
  assert (Fn : is_float n) by apply rnd_float. assert (Fe : is_float er) by apply rnd_float.
  assert (Z1 := rnd_err_sum n (- er) Fn (is_float_opp _ Fe)). change (n + - er) with (n - er) in Z1.
  assert (Z2 := rnd_err_sum n er Fn Fe).
  assert (ut : u * Rabs t <= own / 16 + own / 1000).
  { assert (G : forall x y, Rabs (x - y) <= own -> 16 * u * Rabs x <= own -> u * Rabs y <= own / 16
      + own / 1000).
    { intros x y H I. assert (Rabs y <= Rabs x + own).
      { replace y with (x + - (x - y)) by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
        lra. }
      assert (u * Rabs y <= u * (Rabs x + own)) by (apply Rmult_le_compat_l; lra).
      assert (u * own <= own / 1000) by (assert (u * own <= / 1000 * own) by (apply Rmult_le_compat_r; lra);
        lra). lra. }
    assert (Ga := G _ _ own_a rounds_a). assert (Gb := G _ _ own_b rounds_b).
    assert (Gc := G _ _ own_c rounds_c).
    replace t with (la * da' + lb * db' + lc * dc') by (unfold t, la, lb, lc; field; exact Tn).
    set (m := own / 16 + own / 1000) in *.
    assert (T3 : Rabs (la * da' + lb * db' + lc * dc') <= la * Rabs da' + lb * Rabs db' + lc * Rabs dc').
    { eapply Rle_trans; [apply Rabs_triang|]. assert (Q := Rabs_triang (la * da') (lb * db')).
      rewrite !Rabs_mult, (Rabs_pos_eq la), (Rabs_pos_eq lb) in Q by easy.
      rewrite Rabs_mult, (Rabs_pos_eq lc) by easy. lra. }
    assert (u * Rabs (la * da' + lb * db' + lc * dc') <= u * (la * Rabs da' + lb * Rabs db' + lc * Rabs dc'))
      by (apply Rmult_le_compat_l; lra).
    assert (la * (u * Rabs da') <= la * m) by (apply Rmult_le_compat_l; lra).
    assert (lb * (u * Rabs db') <= lb * m) by (apply Rmult_le_compat_l; lra).
    assert (lc * (u * Rabs dc') <= lc * m) by (apply Rmult_le_compat_l; lra).
    assert ((la + lb + lc) * m = m) by (rewrite L1; ring). lra. }
  assert (Nn : Rabs n <= Rabs t + er).
  { replace n with ((n + t) + - t) by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (ue : u * er <= 0.001 * er) by (apply Rmult_le_compat_r; lra).
  assert (Y1 : u * Rabs (n - er) <= u * (Rabs t + 2 * er)).
  { apply Rmult_le_compat_l; [lra|]. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|].
    rewrite Rabs_Ropp, (Rabs_pos_eq er); lra. }
  assert (Y2 : u * Rabs (n + er) <= u * (Rabs t + 2 * er)).
  { apply Rmult_le_compat_l; [lra|]. eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_pos_eq er); lra. }
  clear - Z1 Z2 O Y1 Y2 ue ut Er xB Op seen_p t10.
  apply Rabs_le_inv in Z1, Z2, O. split; [lra|]. apply Rmin_glb; lra.
Qed.
End Near.

