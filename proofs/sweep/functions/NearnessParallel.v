(** How near a triangle is, of parallel rays: -t of the ray, and the bound on what rounding does to it.

    See "A triangle as four linear functions of the pixel" in docs/speed.md. The formulas, and what is
    common to both projections, are in NearnessCommon.v and NearnessPixel.v, what is made of the depths in
    NearnessDepths.v. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding EdgeFunctions NearnessCommon NearnessPixel NearnessDepths.
Open Scope R_scope.
Local Opaque u eta.

Section Near.
Context {given : sure_pixel} {of_corners : depths}.

Lemma reach_eta : reach * eta <= own / 1000 /\ 10 * (reach * eta) <= own / 100 * amount.
Proof.
  destruct nonneg as [_ [_ [R1 _]]]. assert (N := eta_pos). assert (A0 := amount_not_tiny).
  assert (O := own_not_tiny).
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

Lemma parallel_off : Rabs (value + t) <= 2.3 * ((e_max / amount + t_max / amount) * B) + 1.5 * own.
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
  assert (D : Rabs (value + da + lb * bb + lc * cc)
    <= 2.3 * ((e_max / amount + t_max / amount) * B) + 4.01 * (u * Rabs da) + own / 100 + 8 * (reach * eta)).
  { apply (Rmult_le_reg_r amount); [easy|]. rewrite <- (Rabs_pos_eq amount) at 1 by lra. rewrite <- Rabs_mult.
    replace ((2.3 * ((e_max / amount + t_max / amount) * B) + 4.01 * (u * Rabs da) + own / 100
      + 8 * (reach * eta)) * amount)
      with (2.3 * ((e_max + t_max) * B) + 4.01 * (u * Rabs da) * amount + own / 100 * amount
        + 8 * (reach * eta) * amount) by (field; lra).
    set (p2 := (s * linear c a - lb * amount) * bb) in *.
    set (p3 := (s * linear a b - lc * amount) * cc) in *.
    set (o := (value + da) * amount + s * (linear c a * bb + linear a b * cc)) in *.
    replace ((value + da + lb * bb + lc * cc) * amount) with (o + - p2 + - p3) by (unfold o, p2, p3;
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
  assert (Ea : la = 1 - lb - lc) by lra. assert (R_a := rounds_a).
  clear - Et Ea H1 H2 H3 G2 G3 D R_a Re Op La Lb Lc L1.
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
  rnd (value - error) <= - t <= Rmin (rnd (value + error)) nearest_p.
Proof.
  intros error. assert (Fo := f_own). assert (O := parallel_off). destruct B_facts as [_ [_ [B0 [UB [_ [_ Op]]]]]].
  destruct amount_pos as [A0 [Tp Ep]]. destruct reach_eta as [Re _]. destruct nonneg as [_ [_ [R1 _]]].
  destruct weights as [La [Lb [Lc [L1 Tn]]]].
  assert (U := u_small). assert (P := u_pos). assert (N := eta_pos). assert (M := more_value).
  assert (EE : eta <= reach * eta) by (rewrite <- (Rmult_1_l eta) at 1; apply Rmult_le_compat_r; lra).
  set (n := value) in *. set (ex := e_max / amount + t_max / amount) in *.
  assert (Ex : ex = (e_max + t_max) / amount) by (unfold ex; field; lra).
  assert (ex0 : 0 <= ex). { rewrite Ex. apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra]. }
  unfold error, parallel_error. fold B. rewrite (rnd_2 own), (rnd_4 own) by easy.
  assert (s : 0 <= e_max + t_max) by lra.
  assert (s0 := low_sum e_max t_max (rnd_float _) (rnd_float _) s).
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
  assert (vo : 0 <= rnd (v * g) + 4 * own) by lra.
  assert (t6 := low_sum _ _ (rnd_float _) F4 vo). assert (t7 := rnd_pos _ vo).
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

