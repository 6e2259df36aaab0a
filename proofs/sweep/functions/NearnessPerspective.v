(** How near a triangle is, in perspective: 1 / t of the ray, and the bound on what rounding does to it.

    See "A triangle as four linear functions of the pixel" in docs/speed.md. The formulas, and what is
    common to both projections, are in NearnessCommon.v and NearnessPixel.v. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding EdgeFunctions NearnessCommon NearnessPixel.
Open Scope R_scope.
Local Opaque u eta.

Section Near.
Context {given : sure_pixel}.
Let value := near_perspective a b c up right.

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
    assert (Rabs (z - y / amount) * amount <= (u * Rabs (y / amount) + eta) * amount)
      by (apply Rmult_le_compat_r; lra).
    unfold Rdiv in H. rewrite (Rabs_mult y), (Rabs_pos_eq (/ amount)) in H by (apply Rlt_le, Rinv_0_lt_compat;
      lra).
    replace ((u * (Rabs y * / amount) + eta) * amount) with (u * Rabs y + eta * amount) in H by (field; lra).
    easy. }
  set (S := Rabs f0 + Rabs f1 + Rabs f2). assert (S0 : 0 <= S) by (unfold S; pos).
  assert (US : 0 <= u * S <= 0.0001 * S) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
  assert (T1 := Rabs_triang f0 f1). assert (G : Rabs f2 <= S) by (unfold S; generalize (Rabs_pos f0) (Rabs_pos
    f1); lra).
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

Lemma near_perspective_off : Rabs (value * amount - s * (e_bc + e_ca + e_ab))
  <= 3.01 * e_max + 8 * (reach * eta) * amount.
Proof.
  destruct three as [L1 [S1 [L2 [S2 [L3 S3]]]]]. destruct slack_tiny as [K0 K1].
  destruct amount_pos as [A0 _]. destruct nonneg as [X0 [Y0 [R1 _]]]. assert (Q := unit_low).
  assert (U := u_small). assert (P := u_pos). assert (N := eta_pos).
  assert (O : forall of, (forall v w, is_float (of v w)) -> Rabs (coefficient a b c of * amount - s * (of b c
    + of c a + of a b))
    <= 3.001 * (u * (Rabs (of b c) + Rabs (of c a) + Rabs (of a b))) + eta * amount).
  { intros of F.
    change (coefficient a b c of)
      with (summed amount (rnd (of b c * s)) (rnd (of c a * s)) (rnd (of a b * s))).
    destruct (signed _ (F b c)) as [-> B1], (signed _ (F c a)) as [->
      B2], (signed _ (F a b)) as [-> B3].
    assert (H := summed_off (of b c * s) (of c a * s) (of a b * s)). rewrite B1, B2, B3 in H.
    replace (s * (of b c + of c a + of a b)) with (of b c * s + of c a * s + of a b * s) by ring.
    apply H; [destruct (signed _ (F b c)) as [<- _] | destruct (signed _ (F c a)) as [<- _] | destruct
      (signed _ (F a b)) as [<- _]]; apply rnd_float. }
  assert (O1 := O of_1 ltac:(intros; apply rnd_float)). assert (Oy := O of_y ltac:(intros; apply rnd_float)).
  assert (Ox := O of_x ltac:(intros; apply rnd_float)). clear O.
  assert (AP := at_pixel_off (coefficient a b c of_1) (coefficient a b c of_y) (coefficient a b c of_x) up right reach
    (rnd_float _) in_up in_right).
  change (at_pixel _ _ _ up right) with value in AP.
  set (n1 := coefficient a b c of_1) in *. set (ny := coefficient a b c of_y) in *. set (nx := coefficient a b c of_x) in *.
  set (s1 := Rabs (of_1 b c) + Rabs (of_1 c a) + Rabs (of_1 a b)) in *.
  set (sy := Rabs (of_y b c) + Rabs (of_y c a) + Rabs (of_y a b)) in *.
  set (sx := Rabs (of_x b c) + Rabs (of_x c a) + Rabs (of_x a b)) in *.
  assert (SG : u * (s1 + reach * sy + reach * sx) <= 3.003 * Y + 3 * slack) by (unfold sizes
    in *; unfold s1, sy, sx; lra).
  assert (s1p : 0 <= s1) by (unfold s1; pos). assert (syp : 0 <= sy) by (unfold sy; pos).
  assert (sxp : 0 <= sx) by (unfold sx; pos).
  assert (ry : 0 <= reach * sy) by pos. assert (rx : 0 <= reach * sx) by pos.
  (* the coefficients' own size *)
  assert (Z : forall n g t, Rabs (n * amount - s * g) <= 3.001 * (u * t) + eta * amount -> Rabs g <= t ->
    Rabs n * amount <= 1.0001 * t + eta * amount).
  { intros n g t H G. rewrite <- (Rabs_pos_eq amount) at 1 by lra. rewrite <- Rabs_mult.
    replace (n * amount) with ((n * amount - s * g) + s * g) by ring. eapply Rle_trans; [apply Rabs_triang|].
    assert (Rabs (s * g) = Rabs g).
    { rewrite Rabs_mult. replace (Rabs s) with 1; [ring|].
      destruct (sign_cases (volume a b c)) as [E|E]; unfold s; rewrite E;
        unfold Rabs; destruct Rcase_abs; lra. }
    assert (u * t <= 0.00001 * t) by (apply Rmult_le_compat_r; [generalize (Rabs_pos g); lra | lra]).
    generalize (Rabs_pos g). lra. }
  assert (Tr : forall x y z, Rabs (x + y + z) <= Rabs x + Rabs y + Rabs z).
  { intros. eapply Rle_trans; [apply Rabs_triang|]. generalize (Rabs_triang x y). lra. }
  assert (Z1 := Z _ _ _ O1 (Tr _ _ _)). assert (Zy := Z _ _ _ Oy (Tr _ _ _)).
  assert (Zx := Z _ _ _ Ox (Tr _ _ _)).
  (* the whole *)
  assert (G1 := product_le _ _ _ _ Oy in_up). assert (G2 := product_le _ _ _ _ Ox in_right).
  rewrite <- Rabs_mult in G1, G2.
  assert (G3 : Rabs ((value - (n1 + ny * up + nx * right)) * amount)
    <= 3.001 * (u * (1.0001 * (s1 + reach * sy + reach * sx) + (1 + 2 * reach) * (eta * amount)))
      + 3 * eta * amount).
  { rewrite Rabs_mult, (Rabs_pos_eq amount) by lra.
    eapply Rle_trans; [apply Rmult_le_compat_r; [lra | exact AP]|].
    assert (reach * (Rabs ny * amount) <= reach * (1.0001 * sy + eta * amount)) by (apply Rmult_le_compat_l;
      lra).
    assert (reach * (Rabs nx * amount) <= reach * (1.0001 * sx + eta * amount)) by (apply Rmult_le_compat_l;
      lra).
    assert (u * (Rabs n1 * amount + reach * (Rabs ny * amount) + reach * (Rabs nx * amount))
      <= u * (1.0001 * s1 + eta * amount + reach * (1.0001 * sy + eta * amount) + reach * (1.0001 * sx
        + eta * amount)))
      by (apply Rmult_le_compat_l; lra). lra. }
  assert (EA : 0 <= eta * amount) by pos.
  assert (0 <= u * (s1 + reach * sy + reach * sx)) by (apply Rmult_le_pos; lra).
  assert (ER : eta * amount <= reach * (eta * amount)) by (rewrite <- (Rmult_1_l (eta * amount)) at 1;
    apply Rmult_le_compat_r; lra).
  assert (u * (reach * (eta * amount)) <= 0.00001 * (reach * (eta * amount))) by (apply Rmult_le_compat_r;
    [pos | lra]).
  assert (0 <= u * (eta * amount) <= 0.00001 * (eta * amount)) by (split; [pos | apply Rmult_le_compat_r;
    lra]).
  assert (ID : value * amount - s * (linear b c + linear c a + linear a b)
    = (value - (n1 + ny * up + nx * right)) * amount + (n1 * amount - s * (of_1 b c + of_1 c a
      + of_1 a b))
      + (ny * amount - s * (of_y b c + of_y c a + of_y a b)) * up + (nx * amount - s * (of_x b c + of_x c a
          + of_x a b)) * right)
    by (unfold linear; ring).
  assert (W : Rabs (value * amount - s * (linear b c + linear c a + linear a b))
    <= 6.003 * (u * (s1 + reach * sy + reach * sx)) + 8 * (reach * eta) * amount).
  { rewrite ID. eapply Rle_trans; [apply Rabs_triang|].
    assert (V := Tr ((value - (n1 + ny * up + nx * right)) * amount)
      (n1 * amount - s * (of_1 b c + of_1 c a + of_1 a b)) ((ny * amount - s * (of_y b c + of_y c a
        + of_y a b)) * up)). lra. }
  assert (M : Rabs (s * (linear b c + linear c a + linear a b) - s * (e_bc + e_ca + e_ab)) <= 3 * (X
    + 2.001 * Y + slack)).
  { apply Rabs_le_inv in L1, L2, L3. apply Rabs_le.
    destruct (sign_cases (volume a b c)) as [E|E]; unfold s; rewrite E; lra. }
  replace (value * amount - s * (e_bc + e_ca + e_ab))
    with ((value * amount - s * (linear b c + linear c a + linear a b))
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
  rnd (value - error) <= inverse <= Rmin (rnd (value + error)) nearest.
Proof.
  intros error. assert (O := near_perspective_off). destruct T_sign as [AT [PT _]].
  destruct amount_pos as [A0 [Tp Ep]]. destruct nonneg as [_ [_ [R1 _]]].
  assert (U := u_small). assert (P := u_pos). assert (N := eta_pos). assert (M := more_value).
  assert (Sr := sure).
  set (n := value) in *. set (S := e_bc + e_ca + e_ab) in *.
  assert (Tn : T <> 0) by (intros Z; rewrite Z in PT; lra).
  set (x := t_max / amount). set (ea := e_max / amount).
  assert (Ia : 0 < / amount) by (apply Rinv_0_lt_compat; lra).
  assert (x0 : 0 <= x) by (apply Rmult_le_pos; lra). assert (ea0 : 0 <= ea) by (apply Rmult_le_pos; lra).
  assert (x1 : x <= 1). { apply (Rmult_le_reg_r amount); [easy|]. unfold x.
  replace (t_max / amount * amount) with t_max by (field; lra). lra. }
  assert (nn : 0 < nearest) by lra.
  set (q := S / T) in *.
  assert (Q1 : Rabs (n - q) <= 3.01 * ea + 8 * (reach * eta) + Rabs q * x).
  { apply (Rmult_le_reg_r amount); [easy|]. rewrite <- (Rabs_pos_eq amount) at 1 by lra. rewrite <- Rabs_mult.
    replace ((n - q) * amount) with ((n * amount - s * S) + - (q * (amount - s * T))) by (unfold q; field;
      exact Tn).
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, (Rabs_mult q).
    assert (Rabs q * Rabs (amount - s * T) <= Rabs q * t_max) by (apply Rmult_le_compat_l;
      [apply Rabs_pos | easy]).
    replace ((3.01 * ea + 8 * (reach * eta) + Rabs q * x) * amount)
      with (3.01 * e_max + 8 * (reach * eta) * amount + Rabs q * t_max) by (unfold ea, x; field; lra). lra. }
  assert (Q2 : Rabs q <= nearest + rho * nearest).
  { replace q with ((q - inverse) + inverse) by ring. eapply Rle_trans; [apply Rabs_triang|].
    rewrite (Rabs_pos_eq inverse) by lra. lra. }
  assert (Q3 : Rabs q * x <= (nearest + rho * nearest) * x) by (apply Rmult_le_compat_r; lra).
  destruct rho_fits as [[r0 r1] r2].
  assert (rn : 0 <= rho * nearest <= 2 * ray_error * nearest) by (split; [pos | apply Rmult_le_compat_r;
    lra]).
  assert (xn : 0 <= x * nearest) by pos.
  assert (Q4 : rho * nearest + rho * nearest * x <= 2 * ray_error * nearest + 1/128 * (x * nearest)).
  { destruct r2 as [r2|r2].
    - assert (rho * nearest * x <= rho * nearest * 1) by (apply Rmult_le_compat_l; lra).
      assert (2 * rho * nearest <= 2 * ray_error * nearest) by (apply Rmult_le_compat_r; lra). lra.
    - assert (rho * (x * nearest) <= 1/128 * (x * nearest)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (un : 0 < u * nearest <= 1e-10 * nearest) by (split; [apply Rmult_lt_0_compat;
    lra | apply Rmult_le_compat_r; lra]).
  assert (Et : reach * eta <= 1/1000 * (u * nearest)).
  { assert (reach * eta <= 4294967296 * eta) by (apply Rmult_le_compat_r; lra).
    assert (u * bpow radix2 (-960) <= u * nearest) by (apply Rmult_le_compat_l; lra).
    rewrite u_bpow, <- bpow_plus in H0. simpl Z.add in H0. rewrite <- u_bpow in H0.
    assert (E : eta = / 2 * bpow radix2 (-1074)) by reflexivity.
    change (-1013)%Z with (61 + -1074)%Z in H0. rewrite bpow_plus in H0.
    change (bpow radix2 61) with 2305843009213693952 in H0. lra. }
  assert (eta <= reach * eta) by (rewrite <- (Rmult_1_l eta) at 1; apply Rmult_le_compat_r; lra).
  assert (Off : Rabs (n - inverse) <= 3.01 * ea + 1.008 * (x * nearest) + 2 * ray_error * nearest
    + 1/100 * (u * nearest)).
  { replace (n - inverse) with ((n - q) + (q - inverse)) by ring. eapply Rle_trans; [apply Rabs_triang|].
    lra. }
  (* the bound, from below *)
  assert (Fr : is_float (2 * ray_error)) by (rewrite <- rnd_2 by easy; apply rnd_float).
  assert (F16 : is_float (16 * u)).
  { rewrite u_bpow. change 16 with (bpow radix2 4). rewrite <- bpow_plus. apply generic_format_bpow.
    unfold fexp, FLT_exp, prec. lia. }
  unfold error, perspective_error. rewrite (rnd_2 _ f_ray).
  assert (c0 := low_sum _ _ Fr F16 ltac:(lra)). assert (c1 := rnd_pos (2 * ray_error + 16 * u) ltac:(lra)).
  set (cc := rnd (2 * ray_error + 16 * u)) in *.
  assert (g0 := over_least t_max Tp). fold x in g0.
  set (least := rnd (amount - t_max)) in *.
  assert (g : 0 <= t_max / least) by lra. assert (g1 := low _ g). assert (g2 := rnd_pos _ g).
  assert (h : 0 <= rnd (t_max / least) + cc) by lra.
  assert (h0 := low_sum _ cc (rnd_float _) (rnd_float _) h).
  set (rel := rnd (rnd (t_max / least) + cc)) in *.
  assert (h1 : 0.999 * (x + 2 * ray_error + 16 * u) - eta <= rel) by lra.
  assert (h2 : 0 <= rel) by (apply rnd_pos; lra).
  assert (h3 : (0.999 * (x + 2 * ray_error + 16 * u) - eta) * nearest <= rel * nearest)
    by (apply Rmult_le_compat_r; lra).
  assert (h4 := low (rel * nearest) ltac:(pos)). assert (h5 := rnd_pos (rel * nearest) ltac:(pos)).
  assert (e0 : 0 <= e_max) by lra. assert (k0 := six e_max (rnd_float _) e0).
  assert (e1 : 0 <= rnd (6 * e_max)) by lra. assert (k1 := over_least _ e1). fold least in k1.
  assert (k2 : 0.9999 * (6 * ea) <= rnd (6 * e_max) / amount).
  { unfold ea, Rdiv. assert (0.9999 * (6 * e_max) * / amount <= rnd (6 * e_max) * / amount)
      by (apply Rmult_le_compat_r; lra). lra. }
  assert (k : 0 <= rnd (6 * e_max) / least) by lra.
  assert (k3 := low _ k). assert (k4 := rnd_pos _ k).
  set (big := rnd (rnd (6 * e_max) / least)) in *.
  assert (m0 := low_sum big (rnd (rel * nearest)) (rnd_float _) (rnd_float _) ltac:(lra)).
  assert (m1 := rnd_pos (big + rnd (rel * nearest)) ltac:(lra)).
  set (sum := rnd (big + rnd (rel * nearest))) in *.
  assert (m2 : 1.00999999 * sum <= sum * more) by (rewrite Rmult_comm; apply Rmult_le_compat_l; lra).
  assert (m3 := low (sum * more) ltac:(lra)). assert (m4 := rnd_pos (sum * more) ltac:(lra)).
  set (er := rnd (sum * more)) in *.
  assert (en : eta * nearest <= 1/1000 * (u * nearest)).
  { assert (eta * nearest <= 1/1000 * u * nearest) by (apply Rmult_le_compat_r; [lra | exact eta_u]). lra. }
  assert (ry : 0 <= 2 * ray_error * nearest) by lra.
  assert (en0 : 0 <= eta * nearest) by (apply Rmult_le_pos; lra).
  assert (Er : 1.0081 * (6 * ea + x * nearest + 2 * ray_error * nearest + 16 * (u * nearest)) - 4 * eta
    - 2 * (eta * nearest) <= er) by lra.
  (* the last rounding *)
  assert (Fn : is_float n) by apply rnd_float. assert (Fe : is_float er) by apply rnd_float.
  assert (Z1 := rnd_err_sum n (- er) Fn (is_float_opp _ Fe)). change (n + - er) with (n - er) in Z1.
  assert (Z2 := rnd_err_sum n er Fn Fe).
  assert (Nn : Rabs n <= nearest + er).
  { replace n with ((n - inverse) + inverse) by ring. eapply Rle_trans; [apply Rabs_triang|].
    rewrite (Rabs_pos_eq inverse) by lra. lra. }
  assert (ue : u * er <= 1e-10 * er) by (apply Rmult_le_compat_r; lra).
  assert (Y1 : u * Rabs (n - er) <= u * (nearest + 2 * er)).
  { apply Rmult_le_compat_l; [lra|]. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|].
    rewrite Rabs_Ropp, (Rabs_pos_eq er); lra. }
  assert (Y2 : u * Rabs (n + er) <= u * (nearest + 2 * er)).
  { apply Rmult_le_compat_l; [lra|]. eapply Rle_trans; [apply Rabs_triang|]. rewrite (Rabs_pos_eq er); lra. }
  apply Rabs_le_inv in Z1, Z2, Off. split; [lra|]. apply Rmin_glb; lra.
Qed.
End Near.
