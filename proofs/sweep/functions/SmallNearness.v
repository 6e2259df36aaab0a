(** Triangles with small boxes: how near they are, and its bound.

    See "Small triangles" in docs/speed.md; the code is small_boxes.py. SmallBoxes.v has the formulas,
    the constants and the edge functions. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding EdgeFunctions SmallBoxes.
Open Scope R_scope.

Section Pixel.
Variables (a b c a' b' c' : vec) (up right : R).
Hypothesis Ca : corner a a'. Hypothesis Cb : corner b b'. Hypothesis Cc : corner c c'.
Hypothesis f_up : is_float up. Hypothesis f_right : is_float right.
Hypothesis in_up : Rabs up <= 16. Hypothesis in_right : Rabs right <= 16.
Let d := pixel_ray up right.
Let T := det (flat a') (flat b') (flat c').
Let amount := Rabs (volume a b c).
Let s := sign_of (volume a b c).
Let e_bc := det (flat b') (flat c') d.
Let e_ca := det (flat c') (flat a') d.
Let e_ab := det (flat a') (flat b') d.
Hypothesis not_edge_on : amount > 2 * ET. (* else the triangle goes the long way *)


(** What SmallBoxes.v says of these. *)
Let s_cases : s = 1 \/ s = -1. Proof. apply sign_cases. Qed.
Let s_T : Rabs (amount - s * T) <= ET /\ s * T > ET.
Proof. now apply (SmallBoxes.s_T a b c a' b' c'). Qed.
Let small_off v w v' w' : corner v v' -> corner w w' ->
  Rabs (small_edge s v w up right - s * det (flat v') (flat w') d) <= E.
Proof. now apply SmallBoxes.small_off. Qed.

(** n at the corners, as computed, and exactly: 1 / t or -t of the ray is the mean of the exact
    ones, with the weights e / T. [own] bounds how far they are apart. It is larger than a few
    roundings of them, and far above what underflow may lose. *)
Variables na nb nc own na' nb' nc' : R.
Hypothesis f_na : is_float na. Hypothesis f_nb : is_float nb. Hypothesis f_nc : is_float nc.
Hypothesis own_a : Rabs (na - na') <= own. Hypothesis own_b : Rabs (nb - nb') <= own.
Hypothesis own_c : Rabs (nc - nc') <= own.
Hypothesis own_rounds : 8 * u * Rabs na <= own.
Hypothesis own_not_tiny : tiny <= own.

Lemma amount_range : 2 * ET < amount <= 1735.
Proof.
  split; [apply not_edge_on|]. destruct s_T as [H _]. apply Rabs_le_inv in H. assert (N := numbers).
  destruct (in_17 _ _ Ca) as [_ [A1 A2]], (in_17 _ _ Cb) as [_ [B1 B2]], (in_17 _ _ Cc) as [_ [C1 C2]].
  assert (s * T <= 1734); [|lra].
  eapply Rle_trans; [apply Rle_abs|]. rewrite Rabs_mult. replace (Rabs s) with 1.
  2: { destruct s_cases as [-> | ->]; unfold Rabs; destruct Rcase_abs; lra. }
  rewrite Rmult_1_l.
  assert (q1 := product_le _ _ _ _ A1 B2). assert (q2 := product_le _ _ _ _ A2 B1).
  assert (q3 := product_le _ _ _ _ B1 C2). assert (q4 := product_le _ _ _ _ B2 C1).
  assert (q5 := product_le _ _ _ _ C1 A2). assert (q6 := product_le _ _ _ _ C2 A1).
  rewrite <- Rabs_mult in q1, q2, q3, q4, q5, q6. apply Rabs_le_inv in q1, q2, q3, q4, q5, q6.
  apply Rabs_le. unfold T, det, dot, cross, flat. simpl. lra.
Qed.

Lemma scale_off : Rabs (scale amount * amount - 1) <= u.
Proof.
  assert (N := numbers). destruct amount_range as [L H].
  assert (I : 0 < / amount) by (apply Rinv_0_lt_compat; lra).
  assert (J : amount * / amount = 1) by (apply Rinv_r; lra).
  unfold scale. rewrite Rmax_left by lra. unfold Rdiv. rewrite Rmult_1_l.
  assert (K : Rabs (rnd (/ amount) - / amount) <= u * / amount).
  { rewrite <- (Rabs_pos_eq (/ amount)) at 3 by lra. apply rnd_err_rel. rewrite Rabs_pos_eq by lra.
    assert (/ 1735 <= / amount) by (apply Rinv_le; lra).
    assert (bpow radix2 (-1022) <= bpow radix2 (-11)) by (apply bpow_le; lia).
    simpl (bpow radix2 (-11)) in *. lra. }
  replace (rnd (/ amount) * amount - 1) with ((rnd (/ amount) - / amount) * amount).
  2: { rewrite Rmult_minus_distr_r, (Rmult_comm (/ amount)), J. ring. }
  rewrite Rabs_mult, (Rabs_pos_eq amount) by lra.
  assert (Rabs (rnd (/ amount) - / amount) * amount <= u * / amount * amount) by (apply Rmult_le_compat_r;
    lra).
  replace (u * / amount * amount) with (u * (amount * / amount)) in * by ring. rewrite J in *. lra.
Qed.

(** One of the two terms: an edge times what its unit adds. *)
Lemma one_term lam e x bq : 0 <= lam <= 1 -> Rabs (e - lam * amount) <= E + ET ->
  0 <= bq -> Rabs x <= bq * amount ->
  Rabs (rnd (e * rnd (x * scale amount)) - lam * x) <= 1.02e-5 * bq + 5000 * eta.
Proof.
  intros [L0 L1] He B0 Hx. assert (N := numbers). assert (U := u_pos). assert (V := u_small).
  assert (Et := eta_pos).
  destruct amount_range as [Am A0]. assert (Sc := scale_off). set (sc := scale amount) in *.
  assert (X1 : Rabs (x * sc) <= 1.0001 * bq).
  { apply (Rmult_le_reg_r amount); [lra|]. rewrite <- (Rabs_pos_eq amount) at 1 by lra. rewrite <- Rabs_mult.
    replace (x * sc * amount) with (x * (sc * amount)) by ring. rewrite Rabs_mult.
    assert (Rabs (sc * amount) <= 1.0001) by (apply Rabs_le_inv in Sc; apply Rabs_le; lra).
    generalize (product_le _ _ _ _ Hx H). lra. }
  assert (R1 := rnd_err (x * sc)). set (y := rnd (x * sc)) in *.
  assert (R2 : Rabs (y - x * sc) <= 1.0001 * (u * bq) + eta).
  { assert (u * Rabs (x * sc) <= u * (1.0001 * bq)) by (apply Rmult_le_compat_l; lra). lra. }
  assert (Ub : 0 <= u * bq <= / 9007199254740992 * bq).
  { split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]. }
  assert (Y1 : Rabs y <= 1.0002 * bq + eta).
  { replace y with ((y - x * sc) + x * sc) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Z1 := product_le _ _ _ _ He Y1). rewrite <- Rabs_mult in Z1.
  assert (Z2 : Rabs (amount * y - x) <= 1735 * (2.001 * (u * bq) + eta)).
  { replace (amount * y - x) with (amount * (y - x * sc) + x * (sc * amount - 1)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult, (Rabs_pos_eq amount) by lra.
    assert (amount * Rabs (y - x * sc) <= 1735 * (1.0001 * (u * bq) + eta))
      by (apply Rmult_le_compat; try lra; apply Rabs_pos).
    generalize (product_le _ _ _ _ Hx Sc). intros.
    assert (amount * (u * bq) <= 1735 * (u * bq)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (Z3 : Rabs (lam * (amount * y - x)) <= 1 * (1735 * (2.001 * (u * bq) + eta))).
  { rewrite Rabs_mult, (Rabs_pos_eq lam) by lra. apply Rmult_le_compat; try lra. apply Rabs_pos. }
  assert (g : (E + ET) * (1.0002 * bq + eta) <= 1.0114e-5 * (1.0002 * bq + eta)) by (apply Rmult_le_compat_r;
    lra).
  assert (W : Rabs (e * y - lam * x) <= 1.0118e-5 * bq + 1736 * eta).
  { replace (e * y - lam * x) with ((e - lam * amount) * y + lam * (amount * y - x)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (Q : Rabs (e * y) <= 1736 * bq + 1736 * eta).
  { replace (e * y) with ((e * y - lam * x) + lam * x) by ring. eapply Rle_trans; [apply Rabs_triang|].
    assert (Rabs (lam * x) <= 1 * (bq * amount)).
    { rewrite Rabs_mult, (Rabs_pos_eq lam) by lra. apply Rmult_le_compat; try lra. apply Rabs_pos. }
    assert (bq * amount <= bq * 1735) by (apply Rmult_le_compat_l; lra). lra. }
  assert (R3 := rnd_err (e * y)).
  assert (u * Rabs (e * y) <= u * (1736 * bq + 1736 * eta)) by (apply Rmult_le_compat_l; lra).
  assert (u * eta <= 1 * eta) by (apply Rmult_le_compat_r; lra).
  replace (rnd (e * y) - lam * x) with ((rnd (e * y) - e * y) + (e * y - lam * x)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.

Let N := (e_bc * na' + e_ca * nb' + e_ab * nc') / T.
Let near := nearness amount na nb nc (small_edge s c a up right) (small_edge s a b up right).
Let err := nearness_error amount na nb nc own.

(** Where the ray meets the triangle, the nearness there is between the two that come out. *)
Theorem small_nearness : 0 <= T * e_bc -> 0 <= T * e_ca -> 0 <= T * e_ab ->
  rnd (near - err) <= N <= rnd (near + err).
Proof.
  intros H1 H2 H3. destruct s_T as [AT PT]. assert (Nu := numbers). destruct amount_range as [Am A0].
  assert (U := u_pos). assert (V := u_small). assert (Et := eta_pos). assert (Ty := tiny_eta).
  assert (Tn : T <> 0) by (intros Z; rewrite Z in PT; lra).
  assert (Sum : e_bc + e_ca + e_ab = T) by (unfold e_bc, e_ca, e_ab, T, det, dot, cross, flat, d, pixel_ray;
    simpl; ring).
  (* the weights *)
  set (la := e_bc / T). set (lb := e_ca / T). set (lc := e_ab / T).
  assert (Q : forall x, 0 <= T * x -> 0 <= x / T).
  { intros x H. replace (x / T) with (T * x / (T * T)) by (field; exact Tn).
    apply Rmult_le_pos; [exact H|]. apply Rlt_le, Rinv_0_lt_compat. nra. }
  assert (La : 0 <= la) by (apply Q, H1). assert (Lb : 0 <= lb) by (apply Q, H2).
  assert (Lc : 0 <= lc) by (apply Q, H3).
  assert (L1 : la + lb + lc = 1) by (unfold la, lb, lc; rewrite <- Sum; field; rewrite Sum; exact Tn).
  assert (Weight : forall v w v' w', corner v v' -> corner w w' -> 0 <= det (flat v') (flat w') d / T <= 1 ->
    Rabs (small_edge s v w up right - det (flat v') (flat w') d / T * amount) <= E + ET).
  { intros v w v' w' Cv Cw L. assert (O := small_off v w v' w' Cv Cw).
    set (x := det (flat v') (flat w') d) in *.
    replace (small_edge s v w up right - x / T * amount)
      with ((small_edge s v w up right - s * x) + - (x / T * (amount - s * T))) by (field; exact Tn).
    eapply Rle_trans; [apply Rabs_triang|].
    rewrite Rabs_Ropp, (Rabs_mult (x / T)), (Rabs_pos_eq (x / T)) by lra.
    assert (x / T * Rabs (amount - s * T) <= 1 * ET) by (apply Rmult_le_compat; try lra; apply Rabs_pos).
    lra. }
  set (xb := rnd (nb - na)). set (xc := rnd (nc - na)).
  set (B := Rmax (Rabs xb) (Rabs xc)).
  assert (Bb : Rabs xb <= B) by apply Rmax_l. assert (Bc : Rabs xc <= B) by apply Rmax_r.
  assert (B0 : 0 <= B) by (eapply Rle_trans; [apply Rabs_pos | exact Bb]).
  set (bq := B / amount).
  assert (EB : B = bq * amount) by (unfold bq; field; lra).
  assert (Bq : 0 <= bq) by (apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra]).
  assert (t1 := one_term lb (small_edge s c a up right) xb bq ltac:(lra) (Weight _ _ _ _ Cc Ca
    ltac:(fold e_ca; fold lb; lra)) Bq ltac:(lra)).
  assert (t2 := one_term lc (small_edge s a b up right) xc bq ltac:(lra) (Weight _ _ _ _ Ca Cb
    ltac:(fold e_ab; fold lc; lra)) Bq ltac:(lra)).
  fold xb in t1. fold xc in t2.
  unfold near, nearness. fold xb xc.
  set (p := rnd (small_edge s c a up right * rnd (xb * scale amount))) in *.
  set (q := rnd (small_edge s a b up right * rnd (xc * scale amount))) in *.
  assert (BU : B <= 1735 * bq) by (rewrite EB, Rmult_comm; apply Rmult_le_compat_r; lra).
  assert (Ub : 0 <= u * bq <= / 9007199254740992 * bq) by (split; [apply Rmult_le_pos;
    lra | apply Rmult_le_compat_r; lra]).
  assert (UB : u * B <= 1735 * (u * bq)) by (assert (u * B <= u * (1735 * bq)) by (apply Rmult_le_compat_l;
    lra); lra).
  assert (Ue : u * eta <= / 1000 * eta) by (apply Rmult_le_compat_r; lra).
  assert (Hb : Rabs (lb * xb) <= B).
  { rewrite Rabs_mult, (Rabs_pos_eq lb), <- (Rmult_1_l B) by lra. apply Rmult_le_compat; try lra.
    apply Rabs_pos. }
  assert (Hc : Rabs (lc * xc) <= B).
  { rewrite Rabs_mult, (Rabs_pos_eq lc), <- (Rmult_1_l B) by lra. apply Rmult_le_compat; try lra.
    apply Rabs_pos. }
  apply Rabs_le_inv in t1, t2, Hb, Hc.
  (* the two sums *)
  assert (S1 := rnd_err_sum p q (rnd_float _) (rnd_float _)).
  assert (Spq : Rabs (p + q) <= 3471 * bq + 10000 * eta) by (apply Rabs_le; lra).
  assert (u * Rabs (p + q) <= u * (3471 * bq + 10000 * eta)) by (apply Rmult_le_compat_l; lra).
  set (s2 := rnd (p + q)) in *. apply Rabs_le_inv in S1, Spq.
  assert (S2 := rnd_err_sum s2 na (rnd_float _) f_na).
  assert (Ss : Rabs (s2 + na) <= 3472 * bq + 11000 * eta + Rabs na).
  { eapply Rle_trans; [apply Rabs_triang|].
    assert (Rabs s2 <= 3472 * bq + 11000 * eta) by (apply Rabs_le; lra). lra. }
  assert (u * Rabs (s2 + na) <= u * (3472 * bq + 11000 * eta + Rabs na)) by (apply Rmult_le_compat_l; lra).
  set (n := rnd (s2 + na)) in *. apply Rabs_le_inv in S2.
  (* the differences *)
  assert (Dif : forall x y z, is_float x -> is_float y -> z = rnd (x - y) -> Rabs z <= B ->
    Rabs (z - (x - y)) <= 1736 * (u * bq)).
  { intros x y z Fx Fy -> Hz. assert (X := rnd_err_sum x (- y) Fx (is_float_opp _ Fy)).
    change (x + - y) with (x - y) in X.
    set (z := rnd (x - y)) in *.
    assert (Y : Rabs (x - y) <= 1.0001 * B).
    { assert (T1 := Rabs_triang_inv (x - y) z). rewrite (Rabs_minus_sym _ z) in T1.
      assert (u * Rabs (x - y) <= / 100000 * Rabs (x - y)) by (apply Rmult_le_compat_r;
        [apply Rabs_pos | lra]). lra. }
    assert (u * Rabs (x - y) <= u * (1.0001 * B)) by (apply Rmult_le_compat_l; lra). lra. }
  assert (D1 := Dif nb na xb f_nb f_na eq_refl Bb). assert (D2 := Dif nc na xc f_nc f_na eq_refl Bc).
  assert (D1' : Rabs (lb * (xb - (nb - na))) <= 1 * (1736 * (u * bq))).
  { rewrite Rabs_mult, (Rabs_pos_eq lb) by lra. apply Rmult_le_compat; try lra. apply Rabs_pos. }
  assert (D2' : Rabs (lc * (xc - (nc - na))) <= 1 * (1736 * (u * bq))).
  { rewrite Rabs_mult, (Rabs_pos_eq lc) by lra. apply Rmult_le_compat; try lra. apply Rabs_pos. }
  (* the corners' own *)
  assert (O : forall l x x', 0 <= l -> Rabs (x - x') <= own -> - (l * own) <= l * (x - x') <= l * own).
  { intros l x x' P X. apply Rabs_le_inv in X. split; nra. }
  assert (O1 := O la na na' La own_a). assert (O2 := O lb nb nb' Lb own_b).
  assert (O3 := O lc nc nc' Lc own_c).
  assert (EN : N = la * na' + lb * nb' + lc * nc') by (unfold N, la, lb, lc; field; exact Tn).
  assert (Own : la * own + lb * own + lc * own = own) by (replace (la * own + lb * own + lc * own)
    with ((la + lb + lc) * own) by ring; rewrite L1; ring).
  assert (Ena : na = la * na + lb * na + lc * na) by (replace (la * na + lb * na + lc * na)
    with ((la + lb + lc) * na) by ring; rewrite L1; ring).
  apply Rabs_le_inv in D1', D2'.
  assert (Far : Rabs (n - N) <= 1.126 * own + 2.05e-5 * bq + 20000 * eta) by (apply Rabs_le; lra).
  (* what is computed as the bound *)
  unfold err, nearness_error. fold xb xc B.
  assert (Sc := scale_off). apply Rabs_le_inv in Sc. set (sc := scale amount) in *.
  assert (E0 : 0.9999 * bq <= B * sc).
  { rewrite EB. replace (bq * amount * sc) with (bq * (sc * amount)) by ring. rewrite (Rmult_comm 0.9999).
    apply Rmult_le_compat_l; lra. }
  assert (E1 := low (B * sc) ltac:(lra)). assert (E1' := rnd_pos (B * sc) ltac:(lra)).
  assert (E2a : 1.2e-4 * rnd (B * sc) <= rnd (B * sc) * PER_T) by (rewrite Rmult_comm;
    apply Rmult_le_compat_l; lra).
  assert (E2 := low (rnd (B * sc) * PER_T) ltac:(lra)).
  assert (E2' := rnd_pos (rnd (B * sc) * PER_T) ltac:(lra)).
  assert (E3a : 24 * own <= OWN * own) by (apply Rmult_le_compat_r; lra).
  assert (E3 := low (OWN * own) ltac:(lra)). assert (E3' := rnd_pos (OWN * own) ltac:(lra)).
  assert (E4 := low_sum _ _ (rnd_float (rnd (B * sc) * PER_T)) (rnd_float (OWN * own)) ltac:(lra)).
  set (er := rnd (rnd (rnd (B * sc) * PER_T) + rnd (OWN * own))) in *.
  assert (Er : 1.1e-4 * bq + 23 * own <= er) by lra.
  (* the last rounding *)
  assert (Fn : is_float n) by apply rnd_float. assert (Fe : is_float er) by apply rnd_float.
  assert (R1 := rnd_err_sum n (- er) Fn (is_float_opp _ Fe)). change (n + - er) with (n - er) in R1.
  assert (R2 := rnd_err_sum n er Fn Fe).
  assert (Nn : Rabs n <= 1.001 * Rabs na + 3473 * bq + 12000 * eta).
  { replace n with ((n - (s2 + na)) + (s2 + na)) by ring. eapply Rle_trans; [apply Rabs_triang|].
    assert (Rabs (n - (s2 + na)) <= u * (3472 * bq + 11000 * eta + Rabs na)) by (apply Rabs_le; lra).
    assert (u * Rabs na <= / 1000 * Rabs na) by (apply Rmult_le_compat_r; [apply Rabs_pos | lra]).
    lra. }
  assert (K : forall x, Rabs x <= Rabs n + er -> u * Rabs x <= own + 1e-6 * bq + / 1000 * er).
  { intros x X. assert (u * Rabs x <= u * (1.001 * Rabs na + 3473 * bq + 12000 * eta + er))
      by (apply Rmult_le_compat_l; lra).
    assert (u * er <= / 10000 * er) by (apply Rmult_le_compat_r; lra). lra. }
  assert (K1 := K (n - er)). assert (K2 := K (n + er)).
  specialize (K1 ltac:(unfold Rminus; eapply Rle_trans; [apply Rabs_triang|]; rewrite Rabs_Ropp, (Rabs_pos_eq
    er); lra)).
  specialize (K2 ltac:(eapply Rle_trans; [apply Rabs_triang|]; rewrite (Rabs_pos_eq er); lra)).
  apply Rabs_le_inv in R1, R2, Far. lra.
Qed.
End Pixel.
