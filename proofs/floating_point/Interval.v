(** The interval of t = T / D contains it: [Fractions.interval] of bounds.py.

    It is computed from T and D and their bounds ([bounds] of Signs.v). Where D is known not to be 0,
    the interval contains the exact T / D; else only its lower end is known, for a t that is not
    negative. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Trees Rounding Magnitude Signs.
Open Scope R_scope.
Open Scope string_scope.

(** ** In real numbers: how far T / D is from the computed quotient *)

Section Reals.
Variables T D ET ED : R. (* computed *)
Variables T0 D0 : R. (* exact *)
Hypothesis HT : Rabs (T - T0) <= 3 / 4 * ET.
Hypothesis HD : Rabs (D - D0) <= 3 / 4 * ED.
Hypothesis LT : slack <= ET.
Hypothesis LD : slack <= ED.

Lemma sizes_known : ED < Rabs D -> D0 <> 0 /\ Rabs D - 3 / 4 * ED <= Rabs D0.
Proof.
  intros K. assert (H := Rabs_triang_inv D D0). assert (S := slack_pos).
  assert (Rabs D - 3 / 4 * ED <= Rabs D0) by lra. split; [|assumption].
  intros E. rewrite E, Rabs_R0 in *. lra.
Qed.

(** The exact t is as near to the exact quotient of the computed two as this. *)
Lemma quotient_off : ED < Rabs D ->
  Rabs (T0 / D0 - T / D) <= 3 / 4 * (ET + Rabs (T / D) * ED) / (Rabs D - 3 / 4 * ED).
Proof.
  intros K. destruct (sizes_known K) as [N L]. assert (S := slack_pos).
  assert (ND : D <> 0) by (intros E; rewrite E, Rabs_R0 in K; lra).
  replace (T0 / D0 - T / D) with (((T0 - T) - (T / D) * (D0 - D)) / D0) by (field; auto).
  unfold Rdiv at 1. rewrite Rabs_mult, Rabs_inv.
  assert (P : 0 < Rabs D - 3 / 4 * ED) by lra.
  apply Rmult_le_compat; try apply Rabs_pos.
  - apply Rlt_le, Rinv_0_lt_compat. lra.
  - unfold Rminus at 1. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, Rabs_mult.
    rewrite (Rabs_minus_sym T0), (Rabs_minus_sym D0).
    assert (Rabs (T / D) * Rabs (D - D0) <= Rabs (T / D) * (3 / 4 * ED))
      by (apply Rmult_le_compat_l; [apply Rabs_pos | exact HD]).
    lra.
  - apply Rinv_le; lra.
Qed.

Let t := rnd (T / D).
Let e0 := rnd (rnd (rnd (Rabs t * ED) + ET) / rnd (Rabs D - ED)).
Let more := 1 + / 281474976710656. (* _LOOSE = 1 + 2^-48 *)
Let error := rnd (rnd (rnd (e0 + rnd (u * Rabs t)) * more) + slack).

Hypothesis FD : is_float D.
Hypothesis FED : is_float ED.
Hypothesis FET : is_float ET.

Lemma first_error : ED < Rabs D ->
  3 / 4 * (ET + Rabs (T / D) * ED) / (Rabs D - 3 / 4 * ED) <= e0 + 6 * eta.
Proof.
  intros K. assert (S := slack_pos). assert (U := u_pos). assert (Us := u_small).
  assert (N := eta_pos). assert (NS := eta_slack).
  set (q := Rabs (T / D)). assert (Q : 0 <= q) by apply Rabs_pos.
  set (G := Rabs D - 3 / 4 * ED). assert (GP : ED <= 4 * G) by (unfold G; lra).
  assert (Ht : q * (1 - u) - eta <= Rabs t).
  { assert (H := rnd_err (T / D)). fold t q in H. assert (I := Rabs_triang_inv (T / D) (T / D - t)).
    rewrite (Rabs_minus_sym (T / D) t) in I. fold q in I.
    replace (T / D - (T / D - t)) with t in I by ring. lra. }
  assert (Ptd : 0 <= Rabs t * ED) by (apply Rmult_le_pos; [apply Rabs_pos | lra]).
  assert (H1 := rnd_err (Rabs t * ED)). rewrite (Rabs_right (Rabs t * ED)) in H1 by lra.
  assert (P1 := rnd_pos _ Ptd). set (a1 := rnd (Rabs t * ED)) in *. apply Rabs_le_inv in H1.
  assert (H2 := rnd_err_sum a1 ET (rnd_float _) FET).
  rewrite (Rabs_right (a1 + ET)) in H2 by lra. apply Rabs_le_inv in H2.
  set (a2 := rnd (a1 + ET)) in *.
  assert (H3 := rnd_err_sum (Rabs D) (- ED) (is_float_abs _ FD) (is_float_opp _ FED)).
  fold (Rabs D - ED) in H3. rewrite (Rabs_right (Rabs D - ED)) in H3 by lra. apply Rabs_le_inv in H3.
  set (den := rnd (Rabs D - ED)) in *.
  assert (Pden : 0 < den) by nra.
  assert (Pa2 : 0 < a2) by nra.
  assert (H4 := rnd_err (a2 / den)).
  assert (Pq : 0 < a2 / den) by (apply Rdiv_lt_0_compat; auto).
  rewrite (Rabs_right (a2 / den)) in H4 by lra. apply Rabs_le_inv in H4. fold e0 in H4.
  (* a2 / den >= (1 - 3u) (q ED (1 - 2u) + ET (1 - 2^-14) - eta ED) / G *)
  assert (Hd : den <= (1 + u) * G) by (unfold G; nra).
  assert (A2 : (1 - u) * ((q * (1 - u) - eta) * ED * (1 - u) - eta + ET) <= a2).
  { assert (M : (q * (1 - u) - eta) * ED <= Rabs t * ED) by (apply Rmult_le_compat_r; lra). nra. }
  assert (GP2 : 0 < G) by (unfold G; lra).
  assert (B : a2 / ((1 + u) * G) <= a2 / den).
  { apply Rmult_le_compat_l; [lra|]. apply Rinv_le; lra. }
  assert (C : 3 / 4 * (ET + q * ED) <= (1 - u) * a2 / (1 + u) + 5 * eta * G).
  { clear H3 H4 B Pq Ht HT HD.
    set (x := q * ED). set (z := eta * ED).
    assert (Px : 0 <= x) by (apply Rmult_le_pos; lra). assert (Pz : 0 <= z) by (apply Rmult_le_pos; lra).
    assert (zG : z <= 4 * (eta * G)).
    { unfold z. replace (4 * (eta * G)) with (eta * (4 * G)) by ring. apply Rmult_le_compat_l; lra. }
    assert (ux : 0 <= u * x <= / 1000000 * x) by (split; [now apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
    assert (uux : 0 <= u * (u * x) <= / 1000000 * (u * x)).
    { split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]. }
    assert (uz : 0 <= u * z) by (apply Rmult_le_pos; lra).
    assert (uE : 0 <= u * ET <= / 1000000 * ET) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
    set (w := x * (1 - 2 * u) - z - eta + ET).
    assert (W1 : w <= (q * (1 - u) - eta) * ED * (1 - u) - eta + ET).
    { replace ((q * (1 - u) - eta) * ED * (1 - u) - eta + ET)
        with (x - 2 * (u * x) + u * (u * x) - z + u * z - eta + ET) by (unfold x, z; ring).
      unfold w. lra. }
    assert (W2 : (1 - u) * w <= a2).
    { eapply Rle_trans; [|exact A2]. apply Rmult_le_compat_l; lra. }
    assert (W3 : (1 - 2 * u) * ((1 - u) * w) <= (1 - 2 * u) * a2) by (apply Rmult_le_compat_l; lra).
    assert (W4 : a2 * (1 - 2 * u) <= (1 - u) * a2 / (1 + u)).
    { apply Rmult_le_reg_r with (1 + u); [lra|].
      replace ((1 - u) * a2 / (1 + u) * (1 + u)) with (a2 * (1 - u)) by (field; lra).
      rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|].
      replace ((1 - 2 * u) * (1 + u)) with (1 - u - 2 * (u * u)) by ring. generalize (Rle_0_sqr u). unfold Rsqr. lra. }
    set (wp := x * (1 - 2 * u) + ET * (1 - / 32768)).
    assert (Pwp : 0 <= wp) by (unfold wp; lra).
    assert (W5 : wp - z <= w) by (unfold wp, w; lra).
    set (k := (1 - 2 * u) * (1 - u)).
    assert (K1 : 1 - 3 * u <= k <= 1).
    { replace k with (1 - 3 * u + 2 * (u * u)) by (unfold k; ring). generalize (Rle_0_sqr u). unfold Rsqr.
      assert (u * u <= u * 1) by (apply Rmult_le_compat_l; lra). lra. }
    assert (W6 : k * (wp - z) <= k * w) by (apply Rmult_le_compat_l; lra).
    assert (W7 : (1 - 3 * u) * wp <= k * wp) by (apply Rmult_le_compat_r; lra).
    assert (W8 : k * z <= 1 * z) by (apply Rmult_le_compat_r; lra).
    assert (W9 : (1 - 3 * u) * wp = wp - 3 * (u * x) + 6 * (u * (u * x)) - 3 * (u * ET) * (1 - / 32768)) by (unfold wp; ring).
    replace ((1 - 2 * u) * ((1 - u) * w)) with (k * w) in W3 by (unfold k; ring).
    unfold wp in *. assert (0 <= eta * G) by (apply Rmult_le_pos; lra). lra. }
  assert (E1 : (1 - u) * a2 / (1 + u) / G <= (1 - u) * (a2 / den)).
  { replace ((1 - u) * a2 / (1 + u) / G) with ((1 - u) * (a2 / ((1 + u) * G))) by (field; lra).
    apply Rmult_le_compat_l; lra. }
  assert (E2 : 3 / 4 * (ET + q * ED) / G <= (1 - u) * a2 / (1 + u) / G + 5 * eta).
  { apply Rmult_le_reg_r with G; [exact GP2|].
    replace (3 / 4 * (ET + q * ED) / G * G) with (3 / 4 * (ET + q * ED)) by (field; lra).
    replace (((1 - u) * a2 / (1 + u) / G + 5 * eta) * G) with ((1 - u) * a2 / (1 + u) + 5 * eta * G) by (field; lra).
    exact C. }
  lra.
Qed.

(** The half-width that the code computes covers the exact t. *)
Theorem error_covers : ED < Rabs D -> Rabs (T0 / D0 - t) <= error.
Proof.
  intros K. assert (S := slack_pos). assert (U := u_pos). assert (Us := u_small).
  assert (N := eta_pos). assert (NS := eta_slack).
  assert (H0 := quotient_off K). assert (H1 := first_error K).
  assert (H2 := rnd_err (T / D)). fold t in H2.
  assert (Hq : Rabs (T / D) * (1 - u) <= Rabs t + eta).
  { assert (I := Rabs_triang_inv (T / D) (T / D - t)). rewrite (Rabs_minus_sym (T / D) t) in I.
    replace (T / D - (T / D - t)) with t in I by ring. lra. }
  assert (Pe : 0 <= e0).
  { apply rnd_pos. apply Rmult_le_pos.
    - apply rnd_pos. assert (0 <= rnd (Rabs t * ED)) by (apply rnd_pos, Rmult_le_pos; [apply Rabs_pos | lra]). lra.
    - destruct (Rle_lt_or_eq_dec 0 (rnd (Rabs D - ED))) as [L|L]; [apply rnd_pos; lra | now apply Rlt_le, Rinv_0_lt_compat |].
      rewrite <- L, Rinv_0. lra. }
  assert (Pt : 0 <= u * Rabs t) by (apply Rmult_le_pos; [lra | apply Rabs_pos]).
  assert (H3 := rnd_err (u * Rabs t)). rewrite (Rabs_right (u * Rabs t)) in H3 by lra.
  assert (P3 := rnd_pos _ Pt). set (ut := rnd (u * Rabs t)) in *. apply Rabs_le_inv in H3.
  assert (H4 := rnd_err_sum e0 ut (rnd_float _) (rnd_float _)). rewrite (Rabs_right (e0 + ut)) in H4 by lra.
  set (s1 := rnd (e0 + ut)) in *. apply Rabs_le_inv in H4.
  assert (P4 : 0 <= s1) by nra.
  assert (P5 : 0 <= s1 * more) by (apply Rmult_le_pos; unfold more; lra).
  assert (H5 := rnd_err (s1 * more)). rewrite (Rabs_right (s1 * more)) in H5 by lra.
  assert (P6 := rnd_pos _ P5). set (s2 := rnd (s1 * more)) in *. apply Rabs_le_inv in H5.
  assert (FS : is_float slack) by (rewrite <- (Rmult_1_l slack); apply float_slack).
  assert (H6 := rnd_err_sum s2 slack (rnd_float _) FS). rewrite (Rabs_right (s2 + slack)) in H6 by lra.
  fold error in H6. apply Rabs_le_inv in H6.
  assert (Tri : Rabs (T0 / D0 - t) <= Rabs (T0 / D0 - T / D) + Rabs (t - T / D)).
  { replace (T0 / D0 - t) with ((T0 / D0 - T / D) + - (t - T / D)) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (Hu : u * Rabs (T / D) <= u * Rabs t * (1 + 2 * u) + 2 * eta).
  { set (q := Rabs (T / D)) in *. assert (Q : 0 <= q) by apply Rabs_pos.
    assert (E1 : q <= q * (1 - u) * (1 + 2 * u)).
    { replace (q * (1 - u) * (1 + 2 * u)) with (q + q * u * (1 - 2 * u)) by ring.
      assert (0 <= q * u * (1 - 2 * u)) by (apply Rmult_le_pos; [apply Rmult_le_pos; lra | lra]). lra. }
    assert (E2 : q * (1 - u) * (1 + 2 * u) <= (Rabs t + eta) * (1 + 2 * u)) by (apply Rmult_le_compat_r; lra).
    assert (E3 : u * q <= u * ((Rabs t + eta) * (1 + 2 * u))) by (apply Rmult_le_compat_l; lra).
    assert (E4 : u * (eta * (1 + 2 * u)) <= 1 * (2 * eta)).
    { apply Rmult_le_compat; try lra. apply Rmult_le_pos; lra.
      replace (2 * eta) with (eta * 2) by ring. apply Rmult_le_compat_l; lra. }
    replace (u * ((Rabs t + eta) * (1 + 2 * u))) with (u * Rabs t * (1 + 2 * u) + u * (eta * (1 + 2 * u))) in E3 by ring.
    lra. }
  clear HT HD LT LD Hq P5 P6 Pt.
  set (x := u * Rabs t) in *. set (g := e0 + x).
  assert (Px : 0 <= x) by (apply Rmult_le_pos; [lra | apply Rabs_pos]).
  assert (Pg : 0 <= g) by (unfold g; lra).
  assert (small : forall y, 0 <= y -> 0 <= u * y <= / 1000000 * y).
  { intros y Y. split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]. }
  assert (G0 := small e0 Pe). assert (G1 := small x Px). assert (G2 := small eta (Rlt_le _ _ N)).
  assert (G3 := small (u * x) (proj1 G1)). assert (G4 := small g Pg).
  assert (G5 := small (u * g) (proj1 G4)). assert (G6 := small slack (Rlt_le _ _ S)).
  assert (L0 : (1 - u) * (e0 + (x - (u * x + eta))) <= (1 - u) * (e0 + ut)) by (apply Rmult_le_compat_l; lra).
  assert (L1 : g - 2 * (u * g) - 2 * eta <= s1) by (unfold g in *; lra).
  assert (M1 : more = 1 + 32 * u) by (unfold more; rewrite u_value; simpl; lra).
  set (k := more * (1 - u)).
  assert (K1 : 1 + 30 * u <= k).
  { unfold k. rewrite M1. replace ((1 + 32 * u) * (1 - u)) with (1 + 31 * u - 32 * (u * u)) by ring.
    assert (u * u <= / 1000000 * u) by (apply Rmult_le_compat_r; lra). lra. }
  assert (K2 : s1 * (1 + 30 * u) <= s1 * k) by (apply Rmult_le_compat_l; lra).
  assert (K3 : (g - 2 * (u * g) - 2 * eta) * (1 + 30 * u) <= s1 * (1 + 30 * u)) by (apply Rmult_le_compat_r; lra).
  assert (K4 : s1 * k - eta <= s2).
  { unfold k. replace (s1 * (more * (1 - u))) with (s1 * more - u * (s1 * more)) by ring. lra. }
  assert (L2 : g + 27 * (u * g) - 4 * eta <= s2) by lra.
  assert (L4 : (1 - u) * (g + 27 * (u * g) - 4 * eta + slack) <= (1 - u) * (s2 + slack))
    by (apply Rmult_le_compat_l; lra).
  assert (L5 : g + slack / 2 <= error) by lra.
  unfold g in *. lra.
Qed.

(** Where D may be 0: |T| / |D| at its smallest is not above t. *)
Lemma least_ratio : 11 * u * Rabs T <= ET -> 11 * u * Rabs D <= ED -> D0 <> 0 -> 0 <= T0 / D0 ->
  is_float T -> 0 < rnd (Rabs T - ET) -> 0 < rnd (Rabs D + ED) ->
  rnd (Rabs T - ET) / rnd (Rabs D + ED) * (1 + 3 * u) <= T0 / D0.
Proof.
  intros KT KD ND Pt FT Pn Pd. assert (S := slack_pos). assert (U := u_pos). assert (Us := u_small).
  assert (En := rnd_err_sum (Rabs T) (- ET) (is_float_abs _ FT) (is_float_opp _ FET)).
  fold (Rabs T - ET) in En.
  assert (PN : 0 < Rabs T - ET).
  { destruct (Rle_or_lt (Rabs T - ET) 0) as [L|L]; auto. generalize (rnd_le _ _ L). rewrite rnd_0. lra. }
  rewrite (Rabs_right (Rabs T - ET)) in En by lra. apply Rabs_le_inv in En.
  assert (Ed := rnd_err_sum (Rabs D) ED (is_float_abs _ FD) FED).
  rewrite (Rabs_right (Rabs D + ED)) in Ed by (generalize (Rabs_pos D); lra). apply Rabs_le_inv in Ed.
  set (n := rnd (Rabs T - ET)) in *. set (den := rnd (Rabs D + ED)) in *.
  assert (HT0 : Rabs T - 3 / 4 * ET <= Rabs T0) by (generalize (Rabs_triang_inv T T0); lra).
  assert (HD0 : Rabs D0 <= Rabs D + 3 / 4 * ED).
  { generalize (Rabs_triang_inv D0 D). rewrite (Rabs_minus_sym D0 D). lra. }
  assert (E : T0 / D0 = Rabs T0 / Rabs D0).
  { unfold Rdiv. rewrite <- Rabs_inv, <- Rabs_mult. symmetry. apply Rabs_right. now apply Rle_ge. }
  rewrite E. set (N0 := Rabs T - ET) in *. set (M0 := Rabs D + ED) in *.
  assert (PM : 0 < M0) by (unfold M0; generalize (Rabs_pos D); lra).
  assert (PD0 : 0 < Rabs D0) by now apply Rabs_pos_lt.
  assert (uN : 0 < u * N0) by (apply Rmult_lt_0_compat; lra).
  assert (uM : 0 < u * M0) by (apply Rmult_lt_0_compat; lra).
  assert (T1 : N0 * (1 + 11 / 4 * u) <= Rabs T0).
  { assert (u * N0 <= u * Rabs T) by (apply Rmult_le_compat_l; unfold N0; lra). unfold N0 in *. lra. }
  assert (D1 : Rabs D0 <= M0 * (1 - 27 / 10 * u)).
  { assert (K : 108 / 10 * u * M0 <= ED).
    { assert (u * ED <= / 1000000 * ED) by (apply Rmult_le_compat_r; lra). unfold M0. lra. }
    unfold M0 in *. lra. }
  set (q := n / den). assert (Q : 0 < q) by (apply Rdiv_lt_0_compat; auto).
  assert (V : q * den = n) by (unfold q; field; lra).
  assert (q * (M0 * (1 - u)) <= n) by (rewrite <- V; apply Rmult_le_compat_l; lra).
  set (qM := q * M0). assert (PqM : 0 < qM) by (apply Rmult_lt_0_compat; auto).
  assert (uqM : 0 <= u * qM <= / 1000000 * qM) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
  assert (uuqM : 0 <= u * (u * qM) <= / 1000000 * (u * qM)) by (split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]).
  assert (uuN : u * (u * N0) <= / 1000000 * (u * N0)) by (apply Rmult_le_compat_r; lra).
  assert (Q1 : qM * (1 - u) <= N0 * (1 + u)) by (unfold qM; lra).
  assert (Q2 : qM * (1 - u) * (1 + 32 / 10 * u / 2) <= N0 * (1 + u) * (1 + 32 / 10 * u / 2)).
  { apply Rmult_le_compat_r; lra. }
  assert (Q3 : qM * (1 + 3 * u) * (1 - 27 / 10 * u) <= N0 * (1 + 11 / 4 * u)).
  { replace (qM * (1 + 3 * u) * (1 - 27 / 10 * u)) with (qM + 3 / 10 * (u * qM) - 81 / 10 * (u * (u * qM))) by field.
    replace (qM * (1 - u) * (1 + 32 / 10 * u / 2)) with (qM + 6 / 10 * (u * qM) - 16 / 10 * (u * (u * qM))) in Q2 by field.
    replace (N0 * (1 + u) * (1 + 32 / 10 * u / 2)) with (N0 + 26 / 10 * (u * N0) + 16 / 10 * (u * (u * N0))) in Q2 by field.
    lra. }
  assert (Q4 : q * (1 + 3 * u) * Rabs D0 <= Rabs T0).
  { eapply Rle_trans; [|exact T1]. eapply Rle_trans; [|exact Q3].
    replace (qM * (1 + 3 * u) * (1 - 27 / 10 * u)) with (q * (1 + 3 * u) * (M0 * (1 - 27 / 10 * u))) by (unfold qM; ring).
    apply Rmult_le_compat_l; [apply Rmult_le_pos; lra | exact D1]. }
  apply Rmult_le_reg_r with (Rabs D0); [exact PD0|].
  replace (Rabs T0 / Rabs D0 * Rabs D0) with (Rabs T0) by (field; lra). exact Q4.
Qed.
End Reals.
