(** What a bound is made of is at least as large as what it bounds, in binary64 itself.

    The bound E of a number e has the operations of e, on absolute values and with + in place of -.
    Rounding is monotone, so the computed P is at least the computed |e|, step by step; and where P
    has not overflown, nothing in e has. That is why a comparison with E that turns out true says
    that all is finite: where anything is infinite or NaN, the pair stays undecided.

    [dominates v p e]: p is not negative (it may be infinite, or NaN), and where it is finite, so is
    e, and |e| <= p. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Trees Rounding.
Open Scope R_scope.

Definition not_negative (x : float) : Prop := is_nan x = true \/ Bsign x = false.

Lemma not_negative_value x : not_negative x -> is_finite x = true -> 0 <= B2R x.
Proof.
  destruct x as [s|s| |s m e H]; intros [N|N] F; simpl in *; try discriminate; try apply Rle_refl.
  subst s. apply F2R_ge_0. simpl. lia.
Qed.

Definition above (p x : float) : Prop :=
  not_negative p /\ (is_finite p = true -> is_finite x = true /\ Rabs (B2R x) <= B2R p).

Definition dominates (v : env) (p e : expr) : Prop := above (eval v p) (eval v e).

Lemma B2R_is_float (x : float) : is_float (B2R x).
Proof. apply (generic_format_B2R prec emax). Qed.

Lemma B2R_bounded (x : float) : Rabs (B2R x) < bpow radix2 emax.
Proof. apply abs_B2R_lt_emax. Qed.

(** A sum, a difference, a product, of finite numbers: finite where the rounded one is in range. *)
Lemma plus_in_range x y : is_finite x = true -> is_finite y = true ->
  Rabs (rnd (B2R x + B2R y)) < bpow radix2 emax ->
  is_finite (Bplus mode_NE x y : float) = true.
Proof.
  intros Fx Fy H. generalize (Bplus_correct prec emax _ _ mode_NE x y Fx Fy).
  rewrite Rlt_bool_true; [now intros [_ [F _]] | exact H].
Qed.
Lemma minus_in_range x y : is_finite x = true -> is_finite y = true ->
  Rabs (rnd (B2R x - B2R y)) < bpow radix2 emax ->
  is_finite (Bminus mode_NE x y : float) = true.
Proof.
  intros Fx Fy H. generalize (Bminus_correct prec emax _ _ mode_NE x y Fx Fy).
  rewrite Rlt_bool_true; [now intros [_ [F _]] | exact H].
Qed.
Lemma mult_in_range x y : is_finite x = true -> is_finite y = true ->
  Rabs (rnd (B2R x * B2R y)) < bpow radix2 emax ->
  is_finite (Bmult mode_NE x y : float) = true.
Proof.
  intros Fx Fy H. generalize (Bmult_correct prec emax _ _ mode_NE x y).
  rewrite Rlt_bool_true; [|exact H]. intros [_ [F _]]. now rewrite F, Fx, Fy.
Qed.

Lemma rnd_abs_le a b : Rabs a <= b -> Rabs (rnd a) <= rnd b.
Proof. intros H. rewrite <- rnd_abs. now apply rnd_le. Qed.

(** ** Step by step *)


Ltac finite_cases x := destruct x as [[]|[]| |[] ? ? ?]; simpl in *; try discriminate; auto.

Lemma infinity_not_finite s (x : float) : B2SF x = SpecFloat.S754_infinity s ->
  is_finite x = false /\ Bsign x = s.
Proof. destruct x; simpl; intros H; try discriminate. injection H; auto. Qed.

Lemma not_negative_plus p q : not_negative p -> not_negative q ->
  not_negative (Bplus mode_NE p q).
Proof.
  intros P Q. destruct (is_finite p) eqn:Fp, (is_finite q) eqn:Fq;
    [| revert P Q; unfold not_negative;
       destruct p as [[]|[]| |[] ? ? ?], q as [[]|[]| |[] ? ? ?]; simpl in *; intuition discriminate..].
  assert (Sp : Bsign p = false) by (revert P; unfold not_negative; destruct p; simpl in *; intuition discriminate).
  assert (Sq : Bsign q = false) by (revert Q; unfold not_negative; destruct q; simpl in *; intuition discriminate).
  generalize (Bplus_correct prec emax _ _ mode_NE p q Fp Fq).
  case Rlt_bool_spec; intros _ H.
  - right. destruct H as [_ [_ ->]]. rewrite Sp, Sq.
    generalize (not_negative_value p P Fp) (not_negative_value q Q Fq).
    case Rcompare_spec; simpl; auto; intros; lra.
  - destruct H as [H _]. rewrite Sp in H. right. now apply (infinity_not_finite _ _ H).
Qed.

Lemma not_negative_mult p q : not_negative p -> not_negative q ->
  not_negative (Bmult mode_NE p q).
Proof.
  intros P Q. destruct (is_nan (Bmult mode_NE p q)) eqn:N; [now left|].
  assert (Sp : Bsign p = false)
    by (revert P N; unfold not_negative; destruct p as [[]|[]| |[] ? ? ?], q as [[]|[]| |[] ? ? ?]; simpl in *; intuition discriminate).
  assert (Sq : Bsign q = false)
    by (revert Q N; unfold not_negative; destruct p as [[]|[]| |[] ? ? ?], q as [[]|[]| |[] ? ? ?]; simpl in *; intuition discriminate).
  right. generalize (Bmult_correct prec emax _ _ mode_NE p q).
  case Rlt_bool_spec; intros _ H.
  - destruct H as [_ [_ H]]. rewrite H by exact N. now rewrite Sp, Sq.
  - rewrite Sp, Sq in H. now apply (infinity_not_finite _ _ H).
Qed.

Lemma not_negative_abs x : not_negative (Babs x : float).
Proof. destruct x; unfold not_negative; simpl; auto. Qed.

Lemma compare_nan (x y : float) : is_nan x = true \/ is_nan y = true -> Bcompare x y = None.
Proof.
  destruct x as [[]|[]| |[] ? ? ?], y as [[]|[]| |[] ? ? ?]; simpl; intuition discriminate.
Qed.

Lemma not_negative_max p q : not_negative p -> not_negative q -> not_negative (fmax p q).
Proof.
  intros P Q. unfold fmax. destruct (Bcompare p q) as [[]|]; auto. now left.
Qed.

(** ** Step by step *)

Lemma above_plus p q x y : above p x -> above q y -> above (Bplus mode_NE p q) (Bplus mode_NE x y).
Proof.
  intros [P Px] [Q Qy]. split; [now apply not_negative_plus|]. intros F.
  destruct (plus_finite _ _ F) as [Fp Fq]. destruct (Px Fp) as [Fx Lx]. destruct (Qy Fq) as [Fy Ly].
  assert (L : Rabs (rnd (B2R x + B2R y)) <= rnd (B2R p + B2R q)).
  { apply rnd_abs_le. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  assert (G : is_finite (Bplus mode_NE x y : float) = true).
  { apply plus_in_range; auto. eapply Rle_lt_trans; [exact L|].
    rewrite <- plus_value by exact F. eapply Rle_lt_trans; [apply Rle_abs | apply B2R_bounded]. }
  split; [exact G|]. now rewrite (plus_value x y G), (plus_value p q F).
Qed.

Lemma above_minus p q x y : above p x -> above q y -> above (Bplus mode_NE p q) (Bminus mode_NE x y).
Proof.
  intros [P Px] [Q Qy]. split; [now apply not_negative_plus|]. intros F.
  destruct (plus_finite _ _ F) as [Fp Fq]. destruct (Px Fp) as [Fx Lx]. destruct (Qy Fq) as [Fy Ly].
  assert (L : Rabs (rnd (B2R x - B2R y)) <= rnd (B2R p + B2R q)).
  { apply rnd_abs_le. unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra. }
  assert (G : is_finite (Bminus mode_NE x y : float) = true).
  { apply minus_in_range; auto. eapply Rle_lt_trans; [exact L|].
    rewrite <- plus_value by exact F. eapply Rle_lt_trans; [apply Rle_abs | apply B2R_bounded]. }
  split; [exact G|]. now rewrite (minus_value x y G), (plus_value p q F).
Qed.

Lemma above_mult p q x y : above p x -> above q y -> above (Bmult mode_NE p q) (Bmult mode_NE x y).
Proof.
  intros [P Px] [Q Qy]. split; [now apply not_negative_mult|]. intros F.
  destruct (mult_finite _ _ F) as [Fp Fq]. destruct (Px Fp) as [Fx Lx]. destruct (Qy Fq) as [Fy Ly].
  assert (L : Rabs (rnd (B2R x * B2R y)) <= rnd (B2R p * B2R q)).
  { apply rnd_abs_le. rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. }
  assert (G : is_finite (Bmult mode_NE x y : float) = true).
  { apply mult_in_range; auto. eapply Rle_lt_trans; [exact L|].
    rewrite <- mult_value by exact F. eapply Rle_lt_trans; [apply Rle_abs | apply B2R_bounded]. }
  split; [exact G|]. now rewrite (mult_value x y G), (mult_value p q F).
Qed.

Lemma above_mult_swapped p q x y :
  above p y -> above q x -> above (Bmult mode_NE p q) (Bmult mode_NE x y).
Proof.
  intros [P Py] [Q Qx]. split; [now apply not_negative_mult|]. intros F.
  destruct (mult_finite _ _ F) as [Fp Fq]. destruct (Py Fp) as [Fy Ly]. destruct (Qx Fq) as [Fx Lx].
  assert (L : Rabs (rnd (B2R x * B2R y)) <= rnd (B2R p * B2R q)).
  { apply rnd_abs_le. rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat; auto using Rabs_pos. }
  assert (G : is_finite (Bmult mode_NE x y : float) = true).
  { apply mult_in_range; auto. eapply Rle_lt_trans; [exact L|].
    rewrite <- mult_value by exact F. eapply Rle_lt_trans; [apply Rle_abs | apply B2R_bounded]. }
  split; [exact G|]. now rewrite (mult_value x y G), (mult_value p q F).
Qed.

Lemma above_abs_self (x : float) : above (Babs x) x.
Proof.
  split; [apply not_negative_abs|]. rewrite is_finite_Babs, B2R_Babs. intros F. split; [exact F | apply Rle_refl].
Qed.

Lemma above_abs p (x : float) : above p x -> above p (Babs x).
Proof.
  intros [P Px]. split; [exact P|]. rewrite is_finite_Babs, B2R_Babs, Rabs_Rabsolu. exact Px.
Qed.

Lemma above_same p : not_negative p -> above p p.
Proof.
  intros P. split; [exact P|]. intros F. split; [exact F|].
  rewrite Rabs_right; [apply Rle_refl|]. apply Rle_ge, not_negative_value; auto.
Qed.

(** The larger of two is above what either is above. *)
Lemma above_max p q x : not_negative p -> not_negative q -> above p x \/ above q x -> above (fmax p q) x.
Proof.
  intros P Q H. split; [now apply not_negative_max|]. unfold fmax.
  destruct (Bcompare p q) as [o|] eqn:C; [|simpl; discriminate].
  assert (Np : is_nan p = false /\ is_nan q = false).
  { destruct (is_nan p) eqn:Np, (is_nan q) eqn:Nq; auto;
      rewrite compare_nan in C by auto; discriminate. }
  destruct Np as [Np Nq].
  assert (Sp : Bsign p = false) by (destruct P; congruence).
  assert (Sq : Bsign q = false) by (destruct Q; congruence).
  assert (V : forall a b : float, Bcompare a b = Some o -> is_finite a = true -> is_finite b = true ->
      o = Rcompare (B2R a) (B2R b)).
  { intros a b E Fa Fb. rewrite (Bcompare_correct prec emax a b Fa Fb) in E. congruence. }
  assert (Infinite : forall a : float, is_nan a = false -> is_finite a = false -> Bsign a = false ->
      a = B754_infinity false).
  { intros [] ? ? ?; simpl in *; try discriminate. now subst. }
  destruct (is_finite p) eqn:Fp, (is_finite q) eqn:Fq.
  - rewrite (V p q C Fp Fq).
    destruct H as [[_ H]|[_ H]]; [specialize (H Fp) | specialize (H Fq)]; destruct H as [Fx L];
      case Rcompare_spec; intros; split; auto; lra.
  - rewrite (Infinite q) in C |- * by auto. destruct p; simpl in *; try discriminate; injection C as <-; discriminate.
  - rewrite (Infinite p) in C |- * by auto. destruct q; simpl in *; try discriminate; injection C as <-; discriminate.
  - rewrite (Infinite p), (Infinite q) by auto. destruct o; discriminate.
Qed.
