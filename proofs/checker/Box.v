(** `levels` of verify.py: the box around a square's rays has them in it, whatever is rounded. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core Plus_error Mult_error BinarySingleNaN.
From Reftrace Require Import Trees Rounding Magnitude Finite.
From Reftrace Require Import RecordedDropping.
Open Scope R_scope.
Open Scope string_scope.

(** ** In rounded real numbers *)

Definition middle_of (low high : R) : R := rnd (low + rnd (rnd (high - low) / 2)).
Definition wider : R := 1125899906842625 * bpow radix2 (-50). (* 1 + 2^-50 *)
Definition half_of (low high : R) : R :=
  rnd (Rmax (rnd (high - middle_of low high)) (rnd (middle_of low high - low)) * wider).
Lemma wider_is : 1 + 8 * u <= wider <= 2.
Proof. unfold wider, u. simpl. lra. Qed.

Lemma difference_exact x y : is_float x -> is_float y -> Rabs (x - y) < bpow radix2 (-1022) ->
  rnd (x - y) = x - y.
Proof.
  intros X Y H. apply rnd_id. unfold Rminus. apply (FLT_format_plus_small radix2 (-1074) prec); auto.
  - now apply is_float_opp.
  - apply Rlt_le. eapply Rlt_le_trans; [exact H|]. apply bpow_le. unfold prec. lia.
Qed.
Lemma double_float x : is_float x -> is_float (2 * x).
Proof.
  intros F. replace (2 * x) with (x * bpow radix2 1)
    by (change (bpow radix2 1) with 2; ring).
  apply (mult_bpow_pos_exact_FLT radix2 (-1074) prec); [exact F | lia].
Qed.
Lemma rnd_to_float x y : is_float y -> x <= y -> rnd x <= y.
Proof. intros F H. rewrite <- (rnd_id y F). now apply rnd_le. Qed.
Lemma rnd_from_float x y : is_float x -> x <= y -> x <= rnd y.
Proof. intros F H. rewrite <- (rnd_id x F). now apply rnd_le. Qed.

Section Box.
Variables low high : R.
Hypothesis low_float : is_float low.
Hypothesis high_float : is_float high.
Hypothesis ordered : low <= high.
Notation m := (middle_of low high).
Notation h := (half_of low high).

(** The half of a difference, computed, is not more than the difference. *)
Lemma half_difference : 0 <= rnd (rnd (high - low) / 2) <= high - low.
Proof.
  assert (D := rnd_pos (high - low) ltac:(lra)). split; [apply rnd_pos; lra|].
  destruct (Rlt_or_le (Rabs (high - low)) (bpow radix2 (-1022))) as [S|S].
  - rewrite difference_exact in * by assumption. apply rnd_to_float; [|lra].
    rewrite <- difference_exact by assumption. apply rnd_float.
  - rewrite Rabs_pos_eq in S by lra. assert (E := rnd_err_rel (high - low)).
    rewrite (Rabs_pos_eq (high - low)) in E by lra. specialize (E S). apply Rabs_le_inv in E.
    assert (F := rnd_err (rnd (high - low) / 2)). rewrite (Rabs_pos_eq (_ / 2)) in F by lra.
    apply Rabs_le_inv in F.
    assert (eta <= bpow radix2 (-1022) / 4).
    { unfold eta. replace (-1022)%Z with (-1074 + 52)%Z by lia. rewrite bpow_plus.
      change (bpow radix2 52) with 4503599627370496. generalize (bpow_gt_0 radix2 (-1074)). lra. }
    assert (U := u_small). assert (P := u_pos).
    assert (u * rnd (high - low) <= / 100 * rnd (high - low)) by (apply Rmult_le_compat_r; lra).
    assert (u * (high - low) <= / 100 * (high - low)) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma middle_between : low <= m <= high.
Proof.
  destruct half_difference as [A B]. unfold middle_of. split.
  - apply rnd_from_float; [exact low_float | lra].
  - apply rnd_to_float; [exact high_float | lra].
Qed.
Lemma middle_float : is_float m. Proof. apply rnd_float. Qed.

(** A difference, rounded, and made wider, is not less than the difference. *)
Lemma made_wider x y z : is_float x -> is_float y -> 0 <= x - y -> rnd (x - y) <= z ->
  x - y <= rnd (z * wider).
Proof.
  intros X Y D Z. assert (W := wider_is). assert (U := u_pos). assert (Us := u_small).
  assert (E0 := rnd_pos _ D).
  apply Rle_trans with (rnd (rnd (x - y) * wider)).
  2: { apply rnd_le, Rmult_le_compat_r; lra. }
  destruct (Rlt_or_le (Rabs (x - y)) (bpow radix2 (-1022))) as [S|S].
  - rewrite difference_exact by assumption. apply rnd_from_float.
    + rewrite <- difference_exact by assumption. apply rnd_float.
    + assert ((x - y) * 1 <= (x - y) * wider) by (apply Rmult_le_compat_l; lra). lra.
  - rewrite Rabs_pos_eq in S by lra. assert (E := rnd_err_rel (x - y)).
    rewrite (Rabs_pos_eq (x - y)) in E by lra. specialize (E S). apply Rabs_le_inv in E.
    set (d := rnd (x - y)) in *.
    assert (V : (1 + 8 * u) * ((1 - u) * (x - y)) <= d * wider).
    { rewrite (Rmult_comm d). apply Rmult_le_compat; try lra. apply Rmult_le_pos; lra. }
    assert (0 <= u * (x - y)) by (apply Rmult_le_pos; lra).
    assert (u * (u * (x - y)) <= / 100 * (u * (x - y))) by (apply Rmult_le_compat_r; lra).
    assert (V' : (1 + 6 * u) * (x - y) <= d * wider) by lra.
    assert (F := rnd_err_rel (d * wider)).
    rewrite (Rabs_pos_eq (d * wider)) in F by (apply Rmult_le_pos; lra).
    specialize (F ltac:(lra)). apply Rabs_le_inv in F.
    assert ((1 - u) * ((1 + 6 * u) * (x - y)) <= (1 - u) * (d * wider)) by (apply Rmult_le_compat_l; lra).
    lra.
Qed.
Lemma half_covers r : low <= r <= high -> Rabs (r - m) <= h.
Proof.
  intros R. destruct middle_between as [A B]. assert (M := middle_float).
  assert (H1 := made_wider high m _ high_float M ltac:(lra) (Rmax_l _ (rnd (m - low)))).
  assert (H2 := made_wider m low _ M low_float ltac:(lra) (Rmax_r (rnd (high - m)) _)).
  unfold half_of. unfold Rabs. destruct Rcase_abs; lra.
Qed.
Lemma half_small L : is_float L -> - L <= low -> high <= L -> 0 <= h <= 4 * L.
Proof.
  intros F A B. destruct middle_between as [C D]. assert (W := wider_is). assert (U := u_pos).
  assert (P1 : 0 <= rnd (high - m)) by (apply rnd_pos; lra).
  assert (P : 0 <= Rmax (rnd (high - m)) (rnd (m - low))) by (eapply Rle_trans; [exact P1 | apply Rmax_l]).
  split; [apply rnd_pos, Rmult_le_pos; lra|].
  assert (F2 := double_float L F). assert (F4 := double_float _ F2).
  replace (4 * L) with (2 * (2 * L)) by ring. apply rnd_to_float; [exact F4|].
  assert (Q : Rmax (rnd (high - m)) (rnd (m - low)) <= 2 * L).
  { apply Rmax_lub; apply rnd_to_float; auto; lra. }
  rewrite Rmult_comm. apply Rmult_le_compat; lra.
Qed.
End Box.

(** ** As recorded, in binary64 *)

Lemma is_2 : BinarySingleNaN.B2R (num 1 1) = 2. Proof. simpl. unfold F2R. simpl. lra. Qed.
Lemma half_of_float (x : float) : is_finite (Bdiv mode_NE x (num 1 1)) = true ->
  is_finite x = true /\ B2R (Bdiv mode_NE x (num 1 1)) = rnd (B2R x / 2).
Proof.
  intros F. generalize (Bdiv_correct prec emax _ _ mode_NE x (num 1 1)). rewrite is_2. intros H.
  specialize (H ltac:(lra)).
  assert (L : Rabs (rnd (B2R x / 2)) < bpow radix2 emax).
  { rewrite <- rnd_abs. eapply Rle_lt_trans; [|apply (abs_B2R_lt_emax prec emax x)].
    apply rnd_to_float; [apply is_float_abs, B2R_is_float|].
    unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ 2)) by lra. generalize (Rabs_pos (B2R x)). lra. }
  rewrite Rlt_bool_true in H by exact L. destruct H as (A & B & _). rewrite B in F. now split.
Qed.

Definition middle_code l h := Add (Var l) (Div (Sub (Var h) (Var l)) (Num 1 1)).
Definition half_code l h := Mul (Max (Sub (Var h) (middle_code l h)) (Sub (middle_code l h) (Var l)))
  (Num 1125899906842625 (-50)).
Theorem box_is :
  (square_middle_x, square_middle_y, square_middle_z) =
    (middle_code "lowx" "highx", middle_code "lowy" "highy", middle_code "lowz" "highz") /\
  (square_half_x, square_half_y, square_half_z) =
    (half_code "lowx" "highx", half_code "lowy" "highy", half_code "lowz" "highz").
Proof. split; reflexivity. Qed.

Section Code.
Variables (v : env) (l h : string).
Notation low := (B2R (of_var v l)).
Notation high := (B2R (of_var v h)).
Hypothesis ordered : low <= high.
Lemma middle_right : is_finite (eval v (middle_code l h)) = true ->
  is_finite (Bminus mode_NE (of_var v h) (of_var v l) : float) = true /\
  B2R (eval v (middle_code l h)) = middle_of low high.
Proof.
  unfold middle_code. cbn [eval]. intros F. destruct (plus_finite _ _ F) as [_ G].
  destruct (half_of_float _ G) as [D E]. split; [exact D|].
  now rewrite (plus_value _ _ F), E, (minus_value _ _ D).
Qed.
Lemma half_right : is_finite (eval v (middle_code l h)) = true -> is_finite (eval v (half_code l h)) = true ->
  B2R (eval v (half_code l h)) = half_of low high.
Proof.
  intros M F. destruct (middle_right M) as [D E]. destruct (minus_finite _ _ D) as [Fh Fl].
  destruct (middle_between low high (B2R_is_float _) (B2R_is_float _) ordered) as [A B].
  assert (R : Rabs (rnd (high - low)) < bpow radix2 emax).
  { rewrite <- (minus_value _ _ D). apply abs_B2R_lt_emax. }
  assert (R' : forall x, 0 <= x <= high - low -> Rabs (rnd x) < bpow radix2 emax).
  { intros x X. eapply Rle_lt_trans; [|exact R]. rewrite !Rabs_pos_eq by (apply rnd_pos; lra). apply rnd_le.
    lra. }
  unfold half_code in *. change (eval v (Mul ?x ?y)) with (Bmult mode_NE (eval v x) (eval v y)) in *.
  change (eval v (Max ?x ?y)) with (fmax (eval v x) (eval v y)) in *.
  change (eval v (Sub (Var h) ?y)) with (Bminus mode_NE (of_var v h) (eval v y)) in *.
  change (eval v (Sub ?y (Var l))) with (Bminus mode_NE (eval v y) (of_var v l)) in *.
  set (m := eval v (middle_code l h)) in *.
  assert (F1 : is_finite (Bminus mode_NE (of_var v h) m : float) = true).
  { apply minus_in_range; auto. rewrite E. apply R'. lra. }
  assert (F2 : is_finite (Bminus mode_NE m (of_var v l) : float) = true).
  { apply minus_in_range; auto. rewrite E. apply R'. lra. }
  rewrite (mult_value _ _ F). unfold half_of. f_equal. f_equal.
  - now rewrite (proj2 (fmax_finite _ _ F1 F2)), (minus_value _ _ F1), (minus_value _ _ F2), E.
  - unfold wider. simpl. unfold F2R. simpl. lra.
Qed.
Theorem code_covers r L : is_float L -> - L <= low -> high <= L -> low <= r <= high ->
  is_finite (eval v (middle_code l h)) = true -> is_finite (eval v (half_code l h)) = true ->
  Rabs (B2R (eval v (middle_code l h))) <= L /\ 0 <= B2R (eval v (half_code l h)) <= 4 * L /\
  Rabs (r - B2R (eval v (middle_code l h))) <= B2R (eval v (half_code l h)).
Proof.
  intros FL A B R M H. rewrite (half_right M H), (proj2 (middle_right M)).
  assert (F1 := B2R_is_float (of_var v l)). assert (F2 := B2R_is_float (of_var v h)).
  destruct (middle_between low high F1 F2 ordered) as [C D]. split; [apply Rabs_le; lra|].
  split; [now apply half_small | now apply half_covers].
Qed.
End Code.
