(** The interval of t, as the code computes it in binary64: its ends are on the right sides of T / D. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Trees Rounding Magnitude Signs Interval.
Open Scope R_scope.
Open Scope string_scope.

(** A lower end of +inf says that t is beyond all floats; an end is never NaN. *)
Definition low_end (x : float) (t : R) : Prop :=
  match x with
  | B754_nan => False
  | B754_infinity s => s = true \/ bpow radix2 emax <= t
  | _ => B2R x <= t
  end.
Definition high_end (x : float) (t : R) : Prop :=
  match x with
  | B754_nan => False
  | B754_infinity s => s = false
  | _ => t <= B2R x
  end.

Section Trees.
Variables T ET D ED : expr.
Definition zero := Num 0 0.
Definition loose := Num 281474976710657 (-48). (* 1 + 2^-48 *)
Definition less_loose := Num 281474976710655 (-48). (* 2 less that *)
Definition t_ := Div T D.
Definition first_error_ := Div (Add (Mul (Abs t_) ED) ET) (Sub (Abs D) ED).
Definition error_ :=
  Add (Mul (Add first_error_ (Mul (Num 1 (-53)) (Abs t_))) loose) (Num 1 (-1060)).
Definition known := And (Less ED (Abs D)) (Finite error_).
Definition ratio := Div (Sub (Abs T) ET) (Add (Abs D) ED).
Definition least := Where (Less zero ratio) (Sub (Mul ratio less_loose) (Num 1 (-1060))) zero.
Definition interval_low_ := Where known (Prev (Sub t_ error_)) least.
Definition interval_high_ := Where known (Next (Add t_ error_)) Inf.
End Trees.

(** ** Division *)

Lemma div_value x y : is_finite (Bdiv mode_NE x y : float) = true -> is_finite y = true ->
  B2R y <> 0 -> is_finite x = true /\ B2R (Bdiv mode_NE x y) = rnd (B2R x / B2R y).
Proof.
  intros F Fy N. generalize (Bdiv_correct prec emax _ _ mode_NE x y N).
  case Rlt_bool_spec; intros _ H.
  - destruct H as [H [G _]]. split; [now rewrite <- G | exact H].
  - exfalso. revert F H. generalize (Bdiv mode_NE x y). intros [ | | | ]; simpl; intros; discriminate.
Qed.

Lemma finite_numbers :
  B2R (num 1 (-53)) = u /\ B2R (num 1 (-1060)) = slack /\
  B2R (num 281474976710657 (-48)) = 1 + / 281474976710656 /\
  B2R (num 281474976710655 (-48)) = 1 - / 281474976710656.
Proof.
  repeat split; rewrite num_value by easy.
  - unfold u. simpl. lra.
  - apply Rmult_1_l.
  - simpl. lra.
  - simpl. lra.
Qed.

(** ** The float below a rounded number is not above the number *)

Lemma pred_rnd x : pred radix2 fexp (rnd x) <= x.
Proof.
  destruct (Rle_or_lt (pred radix2 fexp (rnd x)) x) as [H|H]; auto. exfalso.
  assert (F : is_float (pred radix2 fexp (rnd x))) by (apply generic_format_pred; [apply fexp_valid | apply rnd_float]).
  assert (K : rnd x <= rnd (pred radix2 fexp (rnd x))) by (apply rnd_le; lra). rewrite (rnd_id _ F) in K.
  destruct (Req_dec (rnd x) 0) as [Z|Z].
  - rewrite Z in *. rewrite pred_0 in K. generalize (ulp_FLT_0 radix2 (-1074) prec). intros E. fold fexp in E. rewrite E in K.
    generalize (bpow_gt_0 radix2 (-1074)). lra.
  - generalize (pred_lt_id radix2 fexp (rnd x) Z). lra.
Qed.

Lemma succ_rnd x : x <= succ radix2 fexp (rnd x).
Proof.
  generalize (pred_rnd (- x)). rewrite rnd_opp, pred_opp. lra.
Qed.

Lemma minus_low (t e : float) : is_finite t = true -> is_finite e = true -> 0 <= B2R e ->
  forall t0, B2R t - B2R e <= t0 -> low_end (Bpred (Bminus mode_NE t e)) t0.
Proof.
  intros Ft Fe Pe t0 H. generalize (Bminus_correct prec emax _ _ mode_NE t e Ft Fe).
  change (round radix2 (SpecFloat.fexp prec emax) (round_mode mode_NE)) with rnd.
  case Rlt_bool_spec; intros R C.
  - destruct C as [V [F _]]. generalize (Bpred_correct prec emax _ _ _ F). rewrite V.
    case Rlt_bool_spec; intros R2 P.
    + destruct P as [V2 [F2 _]]. revert V2 F2. generalize (Bpred (Bminus mode_NE t e)).
      change (SpecFloat.fexp prec emax) with fexp. generalize (pred_rnd (B2R t - B2R e)).
      intros L x V2 F2. destruct x; simpl in *; try discriminate; lra.
    + revert P. generalize (Bpred (Bminus mode_NE t e)). intros [] P; simpl in *; try discriminate.
      injection P as ->. now left.
  - destruct C as [C _]. assert (Bsign t = true).
    { destruct (Bsign t) eqn:S; auto. exfalso.
      assert (Pt : 0 <= B2R t).
      { apply not_negative_value; auto. now right. }
      assert (L1 := rnd_le (B2R t - B2R e) (B2R t)). assert (L2 := rnd_le (- B2R e) (B2R t - B2R e)).
      rewrite rnd_opp in L2. rewrite (rnd_id (B2R t)) in L1 by apply B2R_is_float.
      rewrite (rnd_id (B2R e)) in L2 by apply B2R_is_float.
      assert (Bt := B2R_bounded t). assert (Be := B2R_bounded e).
      rewrite Rabs_right in Bt by lra. rewrite Rabs_right in Be by lra.
      revert R. unfold Rabs. destruct Rcase_abs; lra. }
    rewrite H0 in C. revert C. generalize (Bminus mode_NE t e). intros [] C; simpl in *; try discriminate.
    injection C as ->. now left.
Qed.

Lemma plus_high (t e : float) : is_finite t = true -> is_finite e = true -> 0 <= B2R e ->
  forall t0, t0 <= B2R t + B2R e -> high_end (Bsucc (Bplus mode_NE t e)) t0.
Proof.
  intros Ft Fe Pe t0 H. generalize (Bplus_correct prec emax _ _ mode_NE t e Ft Fe).
  change (round radix2 (SpecFloat.fexp prec emax) (round_mode mode_NE)) with rnd.
  case Rlt_bool_spec; intros R C.
  - destruct C as [V [F _]]. generalize (Bsucc_correct prec emax _ _ _ F). rewrite V.
    case Rlt_bool_spec; intros R2 P.
    + destruct P as [V2 [F2 _]]. revert V2 F2. generalize (Bsucc (Bplus mode_NE t e)).
      change (SpecFloat.fexp prec emax) with fexp. generalize (succ_rnd (B2R t + B2R e)).
      intros L x V2 F2. destruct x; simpl in *; try discriminate; lra.
    + revert P. generalize (Bsucc (Bplus mode_NE t e)). intros [] P; simpl in *; try discriminate.
      now injection P.
  - destruct C as [C _]. assert (Bsign t = false).
    { destruct (Bsign t) eqn:S; auto. exfalso.
      assert (Pt : B2R t <= 0).
      { destruct t; simpl in *; try lra. subst. apply F2R_le_0. simpl. lia. }
      assert (L1 := rnd_le (B2R t + B2R e) (B2R e)). assert (L2 := rnd_le (B2R t) (B2R t + B2R e)).
      rewrite (rnd_id (B2R e)) in L1 by apply B2R_is_float.
      rewrite (rnd_id (B2R t)) in L2 by apply B2R_is_float.
      assert (Bt := B2R_bounded t). assert (Be := B2R_bounded e).
      rewrite Rabs_left1 in Bt by lra. rewrite Rabs_right in Be by lra.
      revert R. unfold Rabs. destruct Rcase_abs; lra. }
    rewrite H0 in C. revert C. generalize (Bplus mode_NE t e). intros [] C; simpl in *; try discriminate.
    injection C as ->. reflexivity.
Qed.

Section Interval.
Variable v : env.
Variables T ET D ED : expr.
Hypothesis BT : bounds v ET T.
Hypothesis BD : bounds v ED D.
Notation T0 := (ex (real_env v) T).
Notation D0 := (ex (real_env v) D).

Lemma known_facts : holds v (known T ET D ED) = true ->
  is_finite (eval v ED) = true /\ is_finite (eval v ET) = true /\ is_finite (eval v (error_ T ET D ED)) = true /\
  B2R (eval v ED) < Rabs (B2R (eval v D)) /\ is_finite (eval v (t_ T D)) = true /\
  B2R (eval v (t_ T D)) = rnd (B2R (eval v T) / B2R (eval v D)) /\
  Rabs (T0 / D0 - B2R (eval v (t_ T D))) <= B2R (eval v (error_ T ET D ED)).
Proof.
  destruct BT as [PT HT], BD as [PD HD].
  unfold known. cbn [holds]. intros H. apply andb_prop in H. destruct H as [H F].
  destruct (Bcompare (eval v ED) (eval v (Abs D))) as [[]|] eqn:C; try discriminate.
  assert (FD : is_finite (eval v ED) = true) by (eapply decided_finite; eauto).
  destruct (HD FD) as [FdD [LD [SD _]]].
  cbn [eval] in C. rewrite (Bcompare_correct prec emax) in C by (auto; now rewrite is_finite_Babs).
  rewrite B2R_Babs in C. injection C as C. apply Rcompare_Lt_inv in C.
  assert (F' := F). unfold error_ in F'. cbn [eval] in F'.
  destruct (plus_finite _ _ F') as [F1 _]. destruct (mult_finite _ _ F1) as [F2 _].
  destruct (plus_finite _ _ F2) as [F3 F4]. destruct (mult_finite _ _ F4) as [_ F5].
  rewrite is_finite_Babs in F5.
  assert (N : B2R (eval v D) <> 0).
  { intros E. rewrite E, Rabs_R0 in C. generalize (not_negative_value _ PD FD). lra. }
  cbn [eval t_] in F5. destruct (div_value _ _ F5 FdD N) as [FT Vt].
  assert (Fsub : is_finite (Bminus mode_NE (Babs (eval v D)) (eval v ED) : float) = true).
  { apply minus_in_range; auto; [now rewrite is_finite_Babs|]. rewrite B2R_Babs.
    rewrite Rabs_right by (apply Rle_ge, rnd_pos; lra).
    apply Rle_lt_trans with (rnd (Rabs (B2R (eval v D)))).
    - apply rnd_le. generalize (not_negative_value _ PD FD). lra.
    - rewrite rnd_id by apply is_float_abs, B2R_is_float. apply B2R_bounded. }
  assert (Vs := minus_value _ _ Fsub). rewrite B2R_Babs in Vs.
  assert (Ns : B2R (Bminus mode_NE (Babs (eval v D)) (eval v ED)) <> 0).
  { rewrite Vs. assert (E := rnd_err_sum (Rabs (B2R (eval v D))) (- B2R (eval v ED))
      (is_float_abs _ (B2R_is_float _)) (is_float_opp _ (B2R_is_float _))).
    fold (Rabs (B2R (eval v D)) - B2R (eval v ED)) in E. intros Z. rewrite Z in E.
    rewrite Rminus_0_l, Rabs_Ropp in E. rewrite Rabs_right in E by lra. generalize u_small. nra. }
  assert (F3' := F3). unfold first_error_ in F3'. cbn [eval] in F3'.
  destruct (div_value _ _ F3' Fsub Ns) as [F6 V3].
  destruct (plus_finite _ _ F6) as [F7 FET]. destruct (mult_finite _ _ F7) as [F8 _].
  destruct (HT FET) as [FtT [LT [ST _]]].
  repeat split; auto.
  destruct finite_numbers as [Nu [Ns1 [Nl _]]].
  unfold error_ at 1. cbn [eval]. rewrite (plus_value _ _ F'), (mult_value _ _ F1), (plus_value _ _ F2),
    (mult_value _ _ F4).
  unfold loose. cbn [eval]. rewrite Nu, Ns1, Nl.
  unfold first_error_. cbn [eval]. rewrite V3, (plus_value _ _ F6), (mult_value _ _ F7), Vs.
  unfold t_. cbn [eval]. rewrite !B2R_Babs, Vt.
  apply error_covers with (ET := B2R (eval v ET)) (ED := B2R (eval v ED)); auto using B2R_is_float.
Qed.

Lemma error_not_negative : holds v (known T ET D ED) = true -> 0 <= B2R (eval v (error_ T ET D ED)).
Proof.
  intros K. destruct (known_facts K) as [_ [_ [_ [_ [_ [_ H]]]]]].
  generalize (Rabs_pos (T0 / D0 - B2R (eval v (t_ T D)))). lra.
Qed.

(** Where D is known not to be 0, the interval has T / D in it. *)
Theorem known_interval : holds v (known T ET D ED) = true ->
  D0 <> 0 /\ low_end (eval v (interval_low_ T ET D ED)) (T0 / D0) /\
  high_end (eval v (interval_high_ T ET D ED)) (T0 / D0).
Proof.
  intros K. assert (P := error_not_negative K).
  destruct (known_facts K) as [FD [FT [Fe [C [Ft [_ H]]]]]].
  destruct BD as [PD HD]. destruct (HD FD) as [_ [LD [SD _]]].
  apply Rabs_le_inv in H.
  split; [apply (sizes_known (B2R (eval v D)) (B2R (eval v ED)) D0); auto|].
  unfold interval_low_, interval_high_. cbn [eval]. rewrite K. split.
  - apply minus_low; auto. lra.
  - apply plus_high; auto. lra.
Qed.

(** Where D may be 0, t, if it exists and is not negative, is not below the lower end. *)
Theorem unknown_interval : holds v (known T ET D ED) = false ->
  eval v (interval_high_ T ET D ED) = B754_infinity false /\
  (D0 <> 0 -> 0 <= T0 / D0 -> low_end (eval v (interval_low_ T ET D ED)) (T0 / D0)).
Proof.
  intros K. unfold interval_low_, interval_high_. cbn [eval]. rewrite K. split; [reflexivity|].
  intros N P. unfold least. cbn [eval holds].
  assert (Zero : low_end (num 0 0) (T0 / D0)) by exact P.
  destruct (Bcompare (eval v zero) (eval v (ratio T ET D ED))) as [[]|] eqn:C; try exact Zero.
  clear Zero. destruct BT as [PT HT], BD as [PD HD].
  unfold ratio in *. cbn [eval zero] in *.
  (* what is compared is positive: so nothing in it is infinite or NaN *)
  set (n := Bminus mode_NE (Babs (eval v T)) (eval v ET)) in *.
  set (den := Bplus mode_NE (Babs (eval v D)) (eval v ED)) in *.
  assert (Pden : not_negative den) by (apply not_negative_plus; auto using not_negative_abs).
  assert (Fden : is_finite den = true).
  { destruct Pden as [Q|Q]; revert Q C; generalize n den;
      intros [[]|[]| |[] ? ? ?] [[]|[]| |[] ? ? ?]; simpl; intros; try discriminate; auto. }
  destruct (plus_finite _ _ Fden) as [_ FD]. destruct (HD FD) as [FdD [LD [SD KD]]].
  assert (Vden := plus_value _ _ Fden). rewrite B2R_Babs in Vden. fold den in Vden.
  assert (S := slack_pos). assert (U := u_pos). assert (Us := u_small).
  assert (FS : is_float slack) by (rewrite <- (Rmult_1_l slack); apply float_slack).
  assert (Pd : 0 < B2R den).
  { rewrite Vden. apply Rlt_le_trans with slack; auto. apply rnd_ge_float; auto.
    generalize (Rabs_pos (B2R (eval v D))). lra. }
  assert (FT : is_finite (eval v ET) = true).
  { destruct (is_finite (eval v ET)) eqn:F; auto. exfalso.
    assert (Sd : Bsign den = false) by (destruct Pden as [Q|Q]; auto; destruct den; discriminate).
    assert (Nn : n = B754_nan \/ n = B754_infinity true).
    { unfold n. destruct PT as [Q|Q]; destruct (eval v ET) as [ |[]| | ]; simpl in Q, F; try discriminate;
        destruct (eval v T) as [ |[]| | ]; auto. }
    destruct Nn as [Nn|Nn]; rewrite Nn in C; clear - C Fden Sd; destruct den as [[]|[]| |[] ? ? ?];
      simpl in Fden, Sd; try discriminate; cbv in C; discriminate. }
  destruct (HT FT) as [FtT [LT [ST KT]]].
  assert (PT' := not_negative_value _ PT FT).
  assert (Fn : is_finite n = true).
  { apply minus_in_range; auto; [now rewrite is_finite_Babs|]. rewrite B2R_Babs.
    assert (BT' := B2R_bounded (eval v T)). assert (BE := B2R_bounded (eval v ET)).
    rewrite (Rabs_right (B2R (eval v ET))) in BE by lra.
    assert (L1 := rnd_le (Rabs (B2R (eval v T)) - B2R (eval v ET)) (Rabs (B2R (eval v T)))).
    assert (L2 := rnd_le (- B2R (eval v ET)) (Rabs (B2R (eval v T)) - B2R (eval v ET))).
    rewrite rnd_opp in L2. rewrite (rnd_id (B2R (eval v ET))) in L2 by apply B2R_is_float.
    rewrite (rnd_id (Rabs (B2R (eval v T)))) in L1 by apply is_float_abs, B2R_is_float.
    apply Rabs_lt. generalize (Rabs_pos (B2R (eval v T))). lra. }
  assert (Vn := minus_value _ _ Fn). rewrite B2R_Babs in Vn. fold n in Vn.
  destruct finite_numbers as [_ [Ns [_ Nl]]].
  assert (Nd : B2R den <> 0) by lra.
  assert (Dc := Bdiv_correct prec emax _ _ mode_NE n den Nd).
  change (round radix2 (SpecFloat.fexp prec emax) (round_mode mode_NE)) with rnd in Dc.
  assert (Key : 0 < B2R n -> B2R n / B2R den * (1 + 3 * u) <= T0 / D0).
  { rewrite Vn, Vden. intros Pn. apply least_ratio; auto using B2R_is_float. now rewrite <- Vden. }
  assert (Ne := eta_slack). assert (Pe := eta_pos).
  revert Dc. case Rlt_bool_spec; intros R Dc.
  - destruct Dc as [Vq [Fq _]]. rewrite Fn in Fq.
    rewrite (Bcompare_correct prec emax) in C by auto.
    change (B2R (num 0 0)) with 0 in C. injection C as C. apply Rcompare_Lt_inv in C. rewrite Vq in C.
    assert (Pn : 0 < B2R n).
    { destruct (Rle_or_lt (B2R n) 0) as [L|L]; auto. exfalso.
      assert (B2R n / B2R den <= 0).
      { unfold Rdiv. generalize (Rinv_0_lt_compat _ Pd). intros. nra. }
      generalize (rnd_le _ _ H). rewrite rnd_0. lra. }
    specialize (Key Pn). set (q := B2R n / B2R den) in *.
    assert (Pq : 0 < q) by (apply Rdiv_lt_0_compat; auto).
    assert (E1 := rnd_err q). rewrite (Rabs_right q) in E1 by lra. apply Rabs_le_inv in E1.
    set (rq := rnd q) in *.
    assert (M : 0 <= rq * B2R (num 281474976710655 (-48)) <= rq) by (rewrite Nl; split; nra).
    assert (Fm : is_finite (Bmult mode_NE (Bdiv mode_NE n den) (num 281474976710655 (-48)) : float) = true).
    { apply mult_in_range; auto. rewrite Vq.
      assert (L1 := rnd_pos _ (proj1 M)). assert (L2 := rnd_le _ _ (proj2 M)).
      rewrite (rnd_id rq) in L2 by apply rnd_float. rewrite Rabs_right by lra.
      rewrite Rabs_right in R by lra. lra. }
    assert (Vm := mult_value _ _ Fm). rewrite Vq, Nl in Vm. rewrite Nl in M.
    set (less := 1 - / 281474976710656) in *.
    assert (E2 := rnd_err (rq * less)). rewrite (Rabs_right (rq * less)) in E2 by lra.
    assert (Pm := rnd_pos _ (proj1 M)). apply Rabs_le_inv in E2. set (m := rnd (rq * less)) in *.
    assert (E3 := rnd_err_sum m (- slack) (rnd_float _) (is_float_opp _ FS)). fold (m - slack) in E3.
    assert (A3 : Rabs (m - slack) <= m + slack).
    { unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp, !Rabs_right; lra. }
    assert (small : forall y, 0 <= y -> 0 <= u * y <= / 1000000 * y).
    { intros y Y. split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra]. }
    assert (Fl : less = 1 - 32 * u) by (unfold less; rewrite u_value; simpl; lra).
    assert (G1 := small q (Rlt_le _ _ Pq)). assert (G2 := small eta (Rlt_le _ _ Pe)).
    assert (G3 := small slack (Rlt_le _ _ S)). assert (G4 := small (u * q) (proj1 G1)).
    assert (Prq : 0 <= rq) by lra. assert (G5 := small rq Prq). assert (G6 := small (u * rq) (proj1 G5)).
    assert (G7 := small m Pm).
    assert (E4 : rnd (m - slack) <= (m - slack) + u * (m + slack)).
    { apply Rabs_le_inv in E3. assert (u * Rabs (m - slack) <= u * (m + slack)) by (apply Rmult_le_compat_l; lra). lra. }
    assert (E5 : rq * less = rq - 32 * (u * rq)) by (rewrite Fl; ring). rewrite E5 in *.
    assert (m <= rq - 30 * (u * rq) + eta) by lra.
    assert (u * m <= u * rq + eta).
    { assert (u * m <= u * (rq + eta)) by (apply Rmult_le_compat_l; lra). lra. }
    assert (Final : rnd (m - slack) <= T0 / D0).
    { assert (rq - 29 * (u * rq) <= q + 2 * eta).
      { assert (u * rq >= u * q - u * (u * q) - u * eta).
        { assert (u * (q - (u * q + eta)) <= u * rq) by (apply Rmult_le_compat_l; lra). lra. }
        lra. }
      lra. }
    assert (Fs : is_finite (Bminus mode_NE (Bmult mode_NE (Bdiv mode_NE n den) (num 281474976710655 (-48))) (num 1 (-1060)) : float) = true).
    { apply minus_in_range; auto. rewrite Vm, Ns.
      assert (L1 := rnd_le (m - slack) m). assert (L2 := rnd_le (- slack) (m - slack)).
      rewrite rnd_opp in L2. rewrite (rnd_id slack FS) in L2. rewrite (rnd_id m) in L1 by apply rnd_float.
      assert (Bm := B2R_bounded (Bmult mode_NE (Bdiv mode_NE n den) (num 281474976710655 (-48)))).
      rewrite Vm, Rabs_right in Bm by lra.
      assert (Bs := B2R_bounded (num 1 (-1060))). rewrite Ns, Rabs_right in Bs by lra.
      apply Rabs_lt. lra. }
    assert (Vs := minus_value _ _ Fs). rewrite Vm, Ns in Vs.
    unfold less_loose. cbn [eval]. revert Vs Fs.
    generalize (Bminus mode_NE (Bmult mode_NE (Bdiv mode_NE n den) (num 281474976710655 (-48))) (num 1 (-1060))).
    intros [ | | | ] Vs Fs; simpl in *; try discriminate; lra.
  - (* beyond the largest float *)
    assert (I : Bdiv mode_NE n den = B754_infinity false).
    { revert Dc C. generalize (Bdiv mode_NE n den). intros [ |[]| | ]; simpl; intros; try discriminate; auto. }
    unfold less_loose. cbn [eval]. fold n den. rewrite I. 
    assert (E : Bminus mode_NE (Bmult mode_NE (B754_infinity false) (num 281474976710655 (-48))) (num 1 (-1060))
      = B754_infinity false) by reflexivity.
    rewrite E. unfold low_end. right.
    assert (Pn : 0 < B2R n).
    { destruct (Rle_or_lt (B2R n) 0) as [L|L]; auto. exfalso.
      assert (Sn : Bsign n = true).
      { destruct (Rle_lt_or_eq_dec _ _ L) as [L'|L'].
        - destruct n as [ | | |[] m e h]; simpl in *; try discriminate; try lra.
          exfalso. assert (0 <= F2R (Float radix2 (Zpos m) e)) by (apply F2R_ge_0; simpl; lia). simpl in *. lra.
        - exfalso. rewrite L' in R. unfold Rdiv in R. rewrite Rmult_0_l, rnd_0, Rabs_R0 in R.
          generalize (bpow_gt_0 radix2 emax). lra. }
      assert (Sd : Bsign den = false) by (destruct Pden as [Q|Q]; auto; destruct den; discriminate).
      rewrite Sn, Sd in Dc. simpl in Dc. rewrite I in Dc. discriminate. }
    specialize (Key Pn). set (q := B2R n / B2R den) in *.
    assert (Pq : 0 < q) by (apply Rdiv_lt_0_compat; auto).
    assert (E1 := rnd_err q). rewrite (Rabs_right q) in E1 by lra. apply Rabs_le_inv in E1.
    rewrite Rabs_right in R by (apply Rle_ge, rnd_pos; lra).
    assert (bpow radix2 emax <= q + u * q + eta) by lra.
    assert (eta <= u * q).
    { assert (1 <= bpow radix2 emax) by (change 1 with (bpow radix2 0); now apply bpow_le).
      assert (eta <= / 4 * u).
      { unfold eta, u. assert (bpow radix2 (-1074) <= / 4 * bpow radix2 (-52)).
        { change (/ 4) with (bpow radix2 (-2)). rewrite <- bpow_plus. now apply bpow_le. }
        lra. }
      assert (u * q <= / 1000000 * q) by (apply Rmult_le_compat_r; lra).
      assert (u * (/ 2) <= u * q) by (apply Rmult_le_compat_l; lra). lra. }
    lra.
Qed.
End Interval.
