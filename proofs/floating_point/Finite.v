(** What is computed without overflow is what the real numbers say, every operation rounded.

    Of sums, differences and products; integers below and above; the larger of two that are not negative;
    and bits masked away. It is enough that the result is finite: so was all that it is made of
    ([finite_value]). Of quotients and of smaller ones that is not so: 1 / inf is 0. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Trees Rounding Magnitude.
Open Scope R_scope.

(** ** Bits masked away *)

Lemma quot_between m p : (0 < p)%Z -> (Z.abs (Z.quot m p * p) <= Z.abs m)%Z.
Proof.
  intros P. rewrite Z.mul_comm. destruct (Z.le_ge_cases 0 m).
  - generalize (Z.mul_quot_le m p). lia.
  - generalize (Z.mul_quot_ge m p). lia.
Qed.

Theorem keep_value n x : (1 <= n <= 53)%Z -> is_finite x = true -> is_finite (keep n x) = true /\
  B2R (keep n x) = round radix2 (FLT_exp (-1074 + prec - n) n) Ztrunc (B2R x).
Proof.
  intros N F. destruct x as [s|s| |s m e B]; try discriminate.
  { split; [reflexivity|]. simpl. now rewrite round_0 by auto with typeclass_instances. }
  set (M := cond_Zopp s (Z.pos m)). set (k := (53 - n)%Z). set (x := F2R (Float radix2 M e)).
  assert (C : e = cexp radix2 (SpecFloat.fexp prec emax) x) by exact (canonical_bounded prec emax s m e B).
  unfold cexp, SpecFloat.fexp, SpecFloat.emin, prec, emax in C.
  assert (X0 : x = IZR M * bpow radix2 e) by reflexivity.
  assert (P : IZR (2 ^ k) = bpow radix2 k) by (apply (IZR_Zpower radix2); unfold k; lia).
  assert (E : round radix2 (FLT_exp (-1074 + prec - n) n) Ztrunc x = IZR (Z.quot M (2 ^ k) * 2 ^ k) * bpow radix2 e).
  { unfold round, scaled_mantissa, F2R. cbn [Fnum Fexp].
    replace (cexp radix2 (FLT_exp (-1074 + prec - n) n) x) with (k + e)%Z
      by (unfold cexp, FLT_exp, prec, k; lia).
    replace (x * bpow radix2 (- (k + e))) with (IZR M / IZR (2 ^ k)).
    - rewrite Ztrunc_div by (apply Z.pow_nonzero; unfold k; lia). rewrite mult_IZR, P, bpow_plus. ring.
    - rewrite X0, P, Z.opp_add_distr, bpow_plus, (bpow_opp _ k), (bpow_opp _ e).
      assert (A := bpow_gt_0 radix2 k). assert (A' := bpow_gt_0 radix2 e). field. lra. }
  assert (L : Rabs (IZR (Z.quot M (2 ^ k) * 2 ^ k) * bpow radix2 e) <= Rabs x).
  { rewrite X0, !Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|].
    rewrite <- !abs_IZR. apply IZR_le, quot_between, Z.pow_pos_nonneg; unfold k; lia. }
  change (B2R (B754_finite s m e B)) with x. rewrite E. cbn [keep]. fold M k.
  generalize (binary_normalize_correct prec emax _ _ mode_NE (Z.quot M (2 ^ k) * 2 ^ k) e s).
  change (F2R (Float radix2 (Z.quot M (2 ^ k) * 2 ^ k) e)) with (IZR (Z.quot M (2 ^ k) * 2 ^ k) * bpow radix2 e).
  cbv zeta. rewrite <- rnd_round, rnd_id.
  - rewrite Rlt_bool_true; [now intros [-> [-> _]]|].
    eapply Rle_lt_trans; [exact L|]. exact (abs_B2R_lt_emax _ _ (B754_finite s m e B)).
  - rewrite <- E. assert (Prec_gt_0 n) by (unfold Prec_gt_0; lia).
    apply (generic_inclusion_mag _ (FLT_exp (-1074 + prec - n) n)).
    + intros _. unfold fexp, FLT_exp, prec. lia.
    + apply generic_format_round; auto with typeclass_instances.
Qed.

Lemma keep_finite n x : is_finite (keep n x) = true -> is_finite x = true.
Proof. destruct x as [s|s| |s m e B]; auto. simpl. now destruct (Z.eqb n 1). Qed.

(** ** The smaller and the larger of two *)

Lemma fmin_finite (x y : float) : is_finite x = true -> is_finite y = true ->
  is_finite (fmin x y) = true /\ B2R (fmin x y) = Rmin (B2R x) (B2R y).
Proof.
  intros Fx Fy. unfold fmin. rewrite (Bcompare_correct prec emax) by assumption.
  unfold Rmin. case Rcompare_spec; intros; destruct Rle_dec; split; auto; lra.
Qed.
Lemma fmax_finite (x y : float) : is_finite x = true -> is_finite y = true ->
  is_finite (fmax x y) = true /\ B2R (fmax x y) = Rmax (B2R x) (B2R y).
Proof.
  intros Fx Fy. unfold fmax. rewrite (Bcompare_correct prec emax) by assumption.
  unfold Rmax. case Rcompare_spec; intros; destruct Rle_dec; split; auto; lra.
Qed.

(** ** Whole expressions *)

(** Not negative: of such the larger is only finite where both are. *)
Fixpoint unsigned (e : expr) : bool :=
  match e with Abs _ => true | Max a b => unsigned a && unsigned b | _ => false end.
Fixpoint arithmetic (e : expr) : bool :=
  match e with
  | Var _ => true
  | Num m e => Z.ltb (Z.abs m) (2 ^ 53) && Z.leb (-1074) e
  | Add a b | Sub a b | Mul a b => arithmetic a && arithmetic b
  | Max a b => unsigned a && unsigned b && (arithmetic a && arithmetic b)
  | Abs a | Neg a | Floor a | Ceil a => arithmetic a
  | Keep n a => Z.leb 1 n && Z.leb n 53 && arithmetic a
  | _ => false
  end.

Lemma unsigned_not_negative v e : unsigned e = true -> not_negative (eval v e).
Proof.
  induction e; simpl; intros U; try discriminate; [apply not_negative_abs|].
  apply andb_prop in U. destruct U. now apply not_negative_max; auto.
Qed.

(** What is finite of the one is the other's. *)
Definition agrees (v : env) (w : renv) : Prop :=
  forall name, is_finite (of_var v name) = true -> B2R (of_var v name) = r_var w name.
Lemma real_agrees v : agrees v (real_env v).
Proof. easy. Qed.

Theorem finite_value v w e : agrees v w -> arithmetic e = true -> is_finite (eval v e) = true ->
  B2R (eval v e) = fl w e.
Proof.
  intros G. induction e; simpl; intros A F; try discriminate; auto;
    repeat match goal with H : _ && _ = true |- _ => apply andb_prop in H; destruct H end.
  - apply num_value; [now apply Z.ltb_lt | now apply Z.leb_le | exact F].
  - destruct (plus_finite _ _ F). rewrite plus_value, IHe1, IHe2; auto.
  - destruct (minus_finite _ _ F). rewrite minus_value, IHe1, IHe2; auto.
  - destruct (mult_finite _ _ F). rewrite mult_value, IHe1, IHe2; auto.
  - rewrite B2R_Babs, IHe; auto. revert F. now rewrite is_finite_Babs.
  - rewrite B2R_Bopp, IHe; auto. revert F. now rewrite is_finite_Bopp.
  - assert (P := unsigned_not_negative v e1). assert (Q := unsigned_not_negative v e2).
    destruct (proj2 (above_max _ _ _ (P H) (Q H2) (or_introl (above_same _ (P H)))) F) as [F1 _].
    destruct (proj2 (above_max _ _ _ (P H) (Q H2) (or_intror (above_same _ (Q H2)))) F) as [F2 _].
    now rewrite (proj2 (fmax_finite _ _ F1 F2)), IHe1, IHe2.
  - destruct (Bnearbyint_correct prec emax prec_lt_emax mode_DN (eval v e)) as [V [G' _]].
    rewrite G' in F. rewrite V, (IHe A F). apply round_FIX_IZR.
  - destruct (Bnearbyint_correct prec emax prec_lt_emax mode_UP (eval v e)) as [V [G' _]].
    rewrite G' in F. rewrite V, (IHe A F). apply round_FIX_IZR.
  - rewrite (proj2 (keep_value n (eval v e) (conj (proj1 (Z.leb_le _ _) H) (proj1 (Z.leb_le _ _) H1))
      (keep_finite _ _ F))), IHe; auto. now apply keep_finite in F.
Qed.
