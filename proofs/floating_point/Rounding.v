(** How far rounding takes sums and products: one theorem for every expression of +, - and *.

    u = 2^-53 is the most that an operation is off by, relative to its result; eta = 2^-1075 the most
    that a product is, where it is so small that it has fewer digits. [mag] is what docs/accuracy.md
    calls P: the expression with | | on every product and + in place of -. [room] is the same, with an
    eta for every product; [depth] counts the roundings along the longest path. Then

        |computed - exact|  <=  (1 + u)^depth * room - mag.                                        *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core Relative Plus_error.
From Reftrace Require Import Trees.
Open Scope R_scope.

Definition u : R := / 2 * bpow radix2 (-52).
Definition eta : R := / 2 * bpow radix2 (-1074).

Lemma u_value : u = / IZR (2 ^ 53).
Proof. unfold u. simpl. lra. Qed.
Lemma u_pos : 0 < u. Proof. rewrite u_value. simpl. lra. Qed.
Lemma u_small : u <= / 9007199254740992. Proof. rewrite u_value. simpl. lra. Qed.
Lemma eta_pos : 0 < eta. Proof. unfold eta. generalize (bpow_gt_0 radix2 (-1074)). lra. Qed.

Lemma rnd_float x : is_float (rnd x).
Proof. apply generic_format_round; [apply fexp_valid | apply valid_rnd_N]. Qed.
Lemma rnd_id x : is_float x -> rnd x = x.
Proof. intros H. apply round_generic; [apply valid_rnd_N | exact H]. Qed.
Lemma rnd_le x y : x <= y -> rnd x <= rnd y.
Proof. apply round_le; [apply fexp_valid | apply valid_rnd_N]. Qed.
Lemma rnd_0 : rnd 0 = 0. Proof. apply round_0, valid_rnd_N. Qed.
Lemma rnd_pos x : 0 <= x -> 0 <= rnd x.
Proof. intros H. rewrite <- rnd_0. now apply rnd_le. Qed.
Lemma rnd_opp x : rnd (- x) = - rnd x.
Proof. unfold rnd. apply round_NE_opp. Qed.
Lemma rnd_abs x : rnd (Rabs x) = Rabs (rnd x).
Proof.
  unfold Rabs at 1. destruct (Rcase_abs x) as [H|H].
  - rewrite rnd_opp. rewrite Rabs_left1; [reflexivity|]. rewrite <- rnd_0. apply rnd_le. lra.
  - rewrite Rabs_right; [reflexivity|]. apply Rle_ge, rnd_pos. lra.
Qed.
Lemma is_float_opp x : is_float x -> is_float (- x). Proof. apply generic_format_opp. Qed.
Lemma is_float_abs x : is_float x -> is_float (Rabs x). Proof. apply generic_format_abs. Qed.

(** One rounding: relative to the result, or absolute. *)
Lemma rnd_err x : Rabs (rnd x - x) <= u * Rabs x + eta.
Proof.
  destruct (error_N_FLT radix2 (-1074) prec eq_refl (fun n => negb (Z.even n)) x)
    as [d [e [Hd [He [_ H]]]]].
  change (rnd x = x * (1 + d) + e) in H. rewrite H.
  replace (x * (1 + d) + e - x) with (d * x + e) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_mult.
  assert (Rabs d <= u) by exact Hd. assert (Rabs e <= eta) by exact He.
  generalize (Rabs_pos x). nra.
Qed.

(** What is not tiny, and sums and differences of floats, have no absolute error. *)
Lemma rnd_err_rel x : bpow radix2 (-1022) <= Rabs x -> Rabs (rnd x - x) <= u * Rabs x.
Proof.
  intros H.
  destruct (relative_error_N_FLT_ex radix2 (-1074) prec eq_refl (fun n => negb (Z.even n)) x H)
    as [d [Hd E]].
  change (rnd x = x * (1 + d)) in E. rewrite E.
  replace (x * (1 + d) - x) with (d * x) by ring. rewrite Rabs_mult.
  assert (Rabs d <= u) by exact Hd. generalize (Rabs_pos x). nra.
Qed.

Lemma rnd_err_sum x y : is_float x -> is_float y ->
  Rabs (rnd (x + y) - (x + y)) <= u * Rabs (x + y).
Proof.
  intros Hx Hy.
  destruct (Rle_or_lt (bpow radix2 (-1022)) (Rabs (x + y))) as [H|H]; [now apply rnd_err_rel|].
  assert (E : rnd (x + y) = x + y).
  { apply rnd_id. apply (FLT_format_plus_small radix2 (-1074) prec); auto.
    apply Rlt_le. eapply Rlt_le_trans; [exact H|]. apply bpow_le. unfold prec. lia. }
  rewrite E. replace (x + y - (x + y)) with 0 by ring. rewrite Rabs_R0.
  apply Rmult_le_pos; [apply Rlt_le, u_pos | apply Rabs_pos].
Qed.

Definition A (n : nat) : R := (1 + u) ^ n.
Lemma A_ge_1 n : 1 <= A n. Proof. apply pow_R1_Rle. generalize u_pos; lra. Qed.
Lemma A_mono n m : (n <= m)%nat -> A n <= A m.
Proof. intros H. apply Rle_pow; [generalize u_pos; lra | exact H]. Qed.

Section Error.
Variable v : renv.
Hypothesis floats : forall name, is_float (r_var v name).


(** A difference of two leaves is a leaf in [mag]: only its own size counts. *)
Definition leaf (e : expr) : bool := match e with Var _ | Num _ _ => true | _ => false end.

Fixpoint mag (e : expr) : R :=
  match e with
  | Add a b => mag a + mag b
  | Sub a b => if leaf a && leaf b then Rabs (ex v a - ex v b) else mag a + mag b
  | Mul a b => mag a * mag b
  | Abs a | Neg a => mag a
  | _ => Rabs (ex v e)
  end.

Fixpoint room (e : expr) : R :=
  match e with
  | Add a b => room a + room b
  | Sub a b => if leaf a && leaf b then Rabs (ex v a - ex v b) else room a + room b
  | Mul a b => room a * room b + eta
  | Abs a | Neg a => room a
  | _ => Rabs (ex v e)
  end.

Fixpoint depth (e : expr) : nat :=
  match e with
  | Add a b => S (max (depth a) (depth b))
  | Sub a b => if leaf a && leaf b then 1%nat else S (max (depth a) (depth b))
  | Mul a b => S (depth a + depth b)
  | Abs a | Neg a => depth a
  | _ => 0%nat
  end.

Fixpoint ring_expr (e : expr) : Prop := (* only what the theorem is about *)
  match e with
  | Var _ => True
  | Num m e => is_float (IZR m * bpow radix2 e)
  | Add a b | Sub a b | Mul a b => ring_expr a /\ ring_expr b
  | Abs a | Neg a => ring_expr a
  | _ => False
  end.

Lemma fl_float e : ring_expr e -> is_float (fl v e).
Proof.
  induction e; simpl; intros H; try contradiction; auto using rnd_float.
  - now apply is_float_abs, IHe.
  - now apply is_float_opp, IHe.
Qed.

Lemma mag_pos e : 0 <= mag e.
Proof.
  induction e; simpl; try apply Rabs_pos; auto; try lra.
  - destruct (leaf e1 && leaf e2); [apply Rabs_pos | lra].
  - now apply Rmult_le_pos.
Qed.
Lemma room_ge_mag e : mag e <= room e.
Proof.
  induction e; simpl; try apply Rle_refl; try lra; auto.
  - destruct (leaf e1 && leaf e2); [apply Rle_refl | lra].
  - generalize (mag_pos e1) (mag_pos e2) eta_pos. nra.
Qed.
Lemma ex_le_mag e : ring_expr e -> Rabs (ex v e) <= mag e.
Proof.
  induction e; simpl; intros H; try contradiction; try apply Rle_refl.
  - eapply Rle_trans; [apply Rabs_triang|]. destruct H as [H1 H2]. specialize (IHe1 H1). specialize (IHe2 H2). lra.
  - destruct (leaf e1 && leaf e2); [apply Rle_refl|]. destruct H as [H1 H2].
    unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. specialize (IHe1 H1). specialize (IHe2 H2). lra.
  - destruct H as [H1 H2]. rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos.
  - rewrite Rabs_Rabsolu. auto.
  - rewrite Rabs_Ropp. auto.
Qed.

(** One more rounding, of a sum and of a product. *)
Lemma one_more f e m r a : 1 <= a -> m <= r -> Rabs e <= m -> Rabs (f - e) <= a * r - m ->
  Rabs (rnd f - f) <= u * Rabs f -> Rabs (rnd f - e) <= (1 + u) * a * r - m.
Proof.
  intros Ha Hm He Hf Hr. assert (U := u_pos).
  assert (F : Rabs f <= a * r).
  { replace f with ((f - e) + e) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  replace (rnd f - e) with ((rnd f - f) + (f - e)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. nra.
Qed.

Lemma one_more_eta f e m r a : 1 <= a -> m <= r -> Rabs e <= m -> Rabs (f - e) <= a * r - m ->
  Rabs (rnd f - e) <= (1 + u) * a * (r + eta) - m.
Proof.
  intros Ha Hm He Hf. assert (U := u_pos). assert (N := eta_pos). assert (Hr := rnd_err f).
  assert (F : Rabs f <= a * r).
  { replace f with ((f - e) + e) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
  replace (rnd f - e) with ((rnd f - f) + (f - e)) by ring.
  eapply Rle_trans; [apply Rabs_triang|].
  assert (u * Rabs f <= u * (a * r)) by (apply Rmult_le_compat_l; lra).
  assert (1 <= (1 + u) * a) by nra.
  assert (1 * eta <= (1 + u) * a * eta) by (apply Rmult_le_compat_r; lra).
  lra.
Qed.

Theorem error e : ring_expr e -> Rabs (fl v e - ex v e) <= A (depth e) * room e - mag e.
Proof.
  assert (leaves : forall a, leaf a = true -> fl v a = ex v a)
    by (intros []; simpl; intros; reflexivity || discriminate).
  assert (exact : forall x, x - x = 0) by (intros; ring).
  induction e; intros H; try contradiction.
  - simpl. rewrite exact, Rabs_R0. unfold A; simpl. lra.
  - simpl. rewrite exact, Rabs_R0. unfold A; simpl. lra.
  - destruct H as [H1 H2]. specialize (IHe1 H1). specialize (IHe2 H2).
    change (fl v (Add e1 e2)) with (rnd (fl v e1 + fl v e2)).
    change (A (depth (Add e1 e2))) with ((1 + u) * A (max (depth e1) (depth e2))).
    apply one_more.
    + apply A_ge_1.
    + apply (room_ge_mag (Add e1 e2)).
    + apply (ex_le_mag (Add e1 e2)). now split.
    + simpl. replace (fl v e1 + fl v e2 - (ex v e1 + ex v e2)) with ((fl v e1 - ex v e1) + (fl v e2 - ex v e2)) by ring.
      eapply Rle_trans; [apply Rabs_triang|].
      generalize (mag_pos e1) (mag_pos e2) (room_ge_mag e1) (room_ge_mag e2)
        (A_mono _ _ (Nat.le_max_l (depth e1) (depth e2))) (A_mono _ _ (Nat.le_max_r (depth e1) (depth e2))). nra.
    + apply rnd_err_sum; now apply fl_float.
  - destruct H as [H1 H2].
    change (fl v (Sub e1 e2)) with (rnd (fl v e1 - fl v e2)).
    assert (R1 : Rabs (rnd (fl v e1 - fl v e2) - (fl v e1 - fl v e2)) <= u * Rabs (fl v e1 - fl v e2)).
    { apply rnd_err_sum; [now apply fl_float | apply is_float_opp; now apply fl_float]. }
    simpl. destruct (leaf e1 && leaf e2) eqn:L.
    + apply andb_prop in L. destruct L as [L1 L2]. revert R1. rewrite (leaves _ L1), (leaves _ L2).
      intros R1. unfold A. rewrite pow_1. lra.
    + specialize (IHe1 H1). specialize (IHe2 H2).
      change (A (S (max (depth e1) (depth e2)))) with ((1 + u) * A (max (depth e1) (depth e2))).
      apply one_more; auto.
      * apply A_ge_1.
      * generalize (room_ge_mag e1) (room_ge_mag e2). lra.
      * unfold Rminus. eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
        generalize (ex_le_mag e1 H1) (ex_le_mag e2 H2). lra.
      * replace (fl v e1 - fl v e2 - (ex v e1 - ex v e2)) with ((fl v e1 - ex v e1) + - (fl v e2 - ex v e2)) by ring.
        eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
        generalize (mag_pos e1) (mag_pos e2) (room_ge_mag e1) (room_ge_mag e2)
          (A_mono _ _ (Nat.le_max_l (depth e1) (depth e2))) (A_mono _ _ (Nat.le_max_r (depth e1) (depth e2))). nra.
  - destruct H as [H1 H2]. specialize (IHe1 H1). specialize (IHe2 H2).
    change (fl v (Mul e1 e2)) with (rnd (fl v e1 * fl v e2)).
    change (A (depth (Mul e1 e2))) with ((1 + u) * A (depth e1 + depth e2)).
    change (room (Mul e1 e2)) with (room e1 * room e2 + eta).
    apply one_more_eta.
    + apply A_ge_1.
    + simpl. generalize (mag_pos e1) (mag_pos e2) (room_ge_mag e1) (room_ge_mag e2). nra.
    + apply (ex_le_mag (Mul e1 e2)). now split.
    + simpl. unfold A. rewrite pow_add. fold (A (depth e1)) (A (depth e2)).
      replace (fl v e1 * fl v e2 - ex v e1 * ex v e2)
        with ((fl v e1 - ex v e1) * fl v e2 + ex v e1 * (fl v e2 - ex v e2)) by ring.
      eapply Rle_trans; [apply Rabs_triang|]. rewrite 2!Rabs_mult.
      assert (M1 := mag_pos e1). assert (M2 := mag_pos e2).
      assert (E1 := ex_le_mag e1 H1). assert (E2 := ex_le_mag e2 H2).
      assert (Hb : Rabs (fl v e2) <= A (depth e2) * room e2).
      { replace (fl v e2) with ((fl v e2 - ex v e2) + ex v e2) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra. }
      assert (Rabs (fl v e1 - ex v e1) * Rabs (fl v e2) <= (A (depth e1) * room e1 - mag e1) * (A (depth e2) * room e2))
        by (apply Rmult_le_compat; auto using Rabs_pos).
      assert (Rabs (ex v e1) * Rabs (fl v e2 - ex v e2) <= mag e1 * (A (depth e2) * room e2 - mag e2))
        by (apply Rmult_le_compat; auto using Rabs_pos).
      nra.
  - simpl. eapply Rle_trans; [apply Rabs_triang_inv2|]. now apply IHe.
  - simpl. replace (- fl v e - - ex v e) with (- (fl v e - ex v e)) by ring. rewrite Rabs_Ropp. now apply IHe.
Qed.
End Error.

(** (1 + u)^n is little more than 1 + n u. *)
Lemma A_16 : A 16 <= 1 + 17 * u.
Proof. unfold A. rewrite u_value. simpl. lra. Qed.
