(** The recorded stages of [quotient.py] in binary64, and why real numbers are enough for them.

    Whatever comes out finite was made without overflow, and is what the real numbers say: sums,
    products, powers of two ([run_value]) and errors ([error_value]). The quotient's test is
    [Overflow.quotient64_real]. *)
Require Import ZArith Reals Psatz String List Bool.
From Reftrace Require Import Trees Rounding Digits ScalarProduct CrossProduct Ziv Quotient Overflow.
From Reftrace Require Import QuotientCode.
From Reftrace Require RecordedQuotient.
From Flocq Require Import Core BinarySingleNaN.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.
Notation float := Trees.float.

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
  assert (X0 : x = IZR M * pow2 e) by reflexivity.
  assert (P : IZR (2 ^ k) = pow2 k) by (apply (IZR_Zpower radix2); unfold k; lia).
  assert (E : round radix2 (FLT_exp (-1074 + prec - n) n) Ztrunc x = IZR (Z.quot M (2 ^ k) * 2 ^ k) * pow2 e).
  { unfold round, scaled_mantissa, F2R. cbn [Fnum Fexp].
    replace (cexp radix2 (FLT_exp (-1074 + prec - n) n) x) with (k + e)%Z
      by (unfold cexp, FLT_exp, prec, k; lia).
    replace (x * pow2 (- (k + e))) with (IZR M / IZR (2 ^ k)).
    - rewrite Ztrunc_div by (apply Z.pow_nonzero; unfold k; lia). rewrite mult_IZR, P, bpow_plus. ring.
    - rewrite X0, P, Z.opp_add_distr, bpow_plus, (bpow_opp _ k), (bpow_opp _ e).
      assert (A := pow2_pos k). assert (A' := pow2_pos e). field. lra. }
  assert (L : Rabs (IZR (Z.quot M (2 ^ k) * 2 ^ k) * pow2 e) <= Rabs x).
  { rewrite X0, !Rabs_mult. apply Rmult_le_compat_r; [apply Rabs_pos|].
    rewrite <- !abs_IZR. apply IZR_le, quot_between, Z.pow_pos_nonneg; unfold k; lia. }
  change (B2R (B754_finite s m e B)) with x. rewrite E. cbn [keep]. fold M k.
  generalize (binary_normalize_correct prec emax _ _ mode_NE (Z.quot M (2 ^ k) * 2 ^ k) e s).
  change (F2R (Float radix2 (Z.quot M (2 ^ k) * 2 ^ k) e)) with (IZR (Z.quot M (2 ^ k) * 2 ^ k) * pow2 e).
  cbv zeta. rewrite <- rnd_round, rnd_id.
  - rewrite Rlt_bool_true; [now intros [-> [-> _]]|].
    eapply Rle_lt_trans; [exact L|]. exact (abs_B2R_lt_emax _ _ (B754_finite s m e B)).
  - apply (multiple_float e); [eexists; reflexivity | | lia].
    eapply Rle_trans; [exact L|]. eapply Rle_trans; [apply Rlt_le, bpow_mag_gt|]. apply pow2_le. lia.
Qed.

Lemma keep_finite n x : is_finite (keep n x) = true -> is_finite x = true.
Proof. destruct x as [s|s| |s m e B]; auto. simpl. now destruct (Z.eqb n 1). Qed.

(** ** Sums, products, powers of two: finite, they are what the real numbers say *)

(** Not negative: of such the larger is only finite where both are. *)
Fixpoint unsigned (e : expr) : bool :=
  match e with Abs _ => true | Max a b => unsigned a && unsigned b | _ => false end.
Fixpoint plain (e : expr) : bool :=
  match e with
  | Var _ => true
  | Num m e => Z.leb (Z.abs m) (2 ^ 53) && Z.leb (-1074) e && Z.leb e 900
  | Add a b | Sub a b | Mul a b => plain a && plain b
  | Max a b => unsigned a && unsigned b && (plain a && plain b)
  | Abs a | Neg a => plain a
  | Keep n a => Z.leb 1 n && Z.leb n 53 && plain a
  | _ => false
  end.

Definition upwards (x : float) : Prop := x = B754_nan \/ Bsign x = false.
Lemma max_upwards x y : upwards x -> upwards y -> upwards (fmax x y).
Proof. intros X Y. unfold fmax. destruct (Bcompare x y) as [[]|]; auto. now left. Qed.
Lemma unsigned_upwards v e : unsigned e = true -> upwards (eval v e).
Proof.
  induction e; simpl; intros U; try discriminate.
  - destruct (eval v e) as [s|s| |s m x B]; ((now right) || (now left)).
  - apply andb_prop in U. destruct U. now apply max_upwards; auto.
Qed.

Lemma max_finite x y : upwards x -> upwards y -> is_finite (fmax x y) = true ->
  is_finite x = true /\ is_finite y = true.
Proof.
  unfold fmax. intros [->|X] [->|Y]; try (destruct x as [[]|[]| |[] ? ? ?]; discriminate); try discriminate.
  destruct x as [[]|[]| |[] ? ? ?], y as [[]|[]| |[] ? ? ?]; try discriminate; auto.
Qed.
Lemma max_value x y : is_finite x = true -> is_finite y = true ->
  B2R (fmax x y) = Rmax (B2R x) (B2R y).
Proof.
  intros X Y. unfold fmax. rewrite (Bcompare_correct _ _ x y X Y).
  destruct (Rcompare_spec (B2R x) (B2R y)).
  - symmetry. apply Rmax_right. lra.
  - symmetry. apply Rmax_left. lra.
  - symmetry. apply Rmax_left. lra.
Qed.

(** What is finite of the one is the other's. *)
Definition agrees (v : env) (w : renv) : Prop :=
  forall name, is_finite (of_var v name) = true -> B2R (of_var v name) = r_var w name.
Lemma real_agrees v : agrees v (real_env v).
Proof. easy. Qed.

Theorem run_value v w e : agrees v w -> plain e = true -> is_finite (eval v e) = true ->
  B2R (eval v e) = fl w e.
Proof.
  intros G. induction e; simpl; intros A F; try discriminate; auto.
  - apply andb_prop in A. destruct A as [A A3]. apply andb_prop in A. destruct A as [A1 A2].
    apply Z.leb_le in A1, A2, A3. apply float_of_num.
    + apply Rle_lt_trans with (pow2 (53 + 900)); [|now apply bpow_lt].
      rewrite bpow_plus, Rabs_mult, (Rabs_pos_eq (bpow _ _)), <- abs_IZR by apply bpow_ge_0.
      apply Rmult_le_compat; [apply IZR_le; lia | apply bpow_ge_0 | | now apply pow2_le].
      now apply (IZR_le _ (2 ^ 53)).
    + apply (multiple_float e); [eexists; reflexivity | | exact A2].
      rewrite Z.add_comm, bpow_plus, Rabs_mult, (Rabs_pos_eq (bpow _ _)), <- abs_IZR by apply bpow_ge_0.
      apply Rmult_le_compat_r; [apply bpow_ge_0|]. now apply (IZR_le _ (2 ^ 53)).
  - apply andb_prop in A. destruct A. destruct (plus_finite _ _ F). rewrite plus_value, IHe1, IHe2; auto.
  - apply andb_prop in A. destruct A. destruct (minus_finite _ _ F). rewrite minus_value, IHe1, IHe2; auto.
  - apply andb_prop in A. destruct A. destruct (mult_finite _ _ F). rewrite mult_value, IHe1, IHe2; auto.
  - rewrite B2R_Babs, IHe; auto. revert F. now rewrite is_finite_Babs.
  - rewrite B2R_Bopp, IHe; auto. revert F. now rewrite is_finite_Bopp.
  - apply andb_prop in A. destruct A as [U A]. apply andb_prop in A, U. destruct A as [A1 A2], U as [U1 U2].
    destruct (max_finite _ _ (unsigned_upwards v _ U1) (unsigned_upwards v _ U2) F) as [F1 F2].
    now rewrite max_value, IHe1, IHe2.
  - apply andb_prop in A. destruct A as [N A]. apply andb_prop in N. destruct N as [N1 N2].
    apply Z.leb_le in N1, N2. assert (K := keep_finite _ _ F).
    rewrite (proj2 (keep_value n _ (conj N1 N2) K)). now rewrite IHe.
Qed.

(** ** Errors: finite, they are in range *)

Lemma error64_finite x y : is_finite (error64 x y) = true -> is_finite x = true /\ is_finite y = true.
Proof.
  unfold error64. cbv zeta. destruct (less64 _ _ && less64 _ _); [|discriminate].
  intros F. apply mult_finite in F. now apply mult_finite.
Qed.
Lemma plain_no_inf v e : plain e = true -> no_inf v e = true.
Proof.
  induction e; simpl; intros A; auto; try discriminate; repeat (apply andb_prop in A; destruct A as [? A]);
    rewrite ?IHe1, ?IHe2; auto.
Qed.

Theorem error_value v w unit size : agrees v w -> plain unit = true -> plain size = true ->
  is_finite (eval v (error_tree unit size)) = true ->
  no_inf w (error_tree unit size) = true /\
  B2R (eval v (error_tree unit size)) = fl w (error_tree unit size) /\
  is_finite (eval v unit) = true /\ is_finite (eval v size) = true.
Proof.
  intros G P1 P2 F. change (eval v (error_tree unit size)) with (error64 (eval v unit) (eval v size)) in *.
  destruct (error64_real _ _ F) as [R ->]. destruct (error64_finite _ _ F) as [F1 F2].
  rewrite (run_value v w unit G P1 F1), (run_value v w size G P2 F2) in *.
  assert (N : no_inf w (error_tree unit size) = true).
  { apply error_code_inf; auto using plain_no_inf. }
  split; [exact N|]. split; [|now split]. symmetry. now apply error_code.
Qed.

(** Of a triangle's normal: inf, where it is too small. *)
Theorem normal_error_value v w : agrees v w -> is_finite (eval v RecordedQuotient.normal_M) = true ->
  no_inf w RecordedQuotient.normal_M = true /\ B2R (eval v RecordedQuotient.normal_M) = fl w RecordedQuotient.normal_M.
Proof.
  set (M := Mul (above (away "bx" "ax") (away "by" "ay") (away "bz" "az"))
    (above (away "cx" "ax") (away "cy" "ay") (away "cz" "az"))). intros G.
  change RecordedQuotient.normal_M with (Where (Less (Num 1 (-950)) M) M Inf).
  assert (P : plain M = true) by reflexivity. clearbody M. cbn [eval holds no_inf value truth].
  fold (less64 (num 1 (-950)) (eval v M)).
  destruct (power_value (-950)) as [N1 N2]; [lia|].
  destruct (less64 _ _) eqn:L; [|discriminate]. intros F.
  apply (less64_value _ _ N1 F) in L. rewrite N2, (run_value v w M G P F) in L.
  rewrite Rmult_1_l, Rlt_bool_true by exact L. split; [now apply plain_no_inf | now apply run_value].
Qed.

(** ** The quotient *)

Theorem quotient_eval v : (eval v RecordedQuotient.quotient_t, holds v RecordedQuotient.quotient_sure) =
  quotient64 (keep 26) (of_var v "T1") (of_var v "T2") (of_var v "ET")
    (of_var v "D1") (of_var v "D2") (of_var v "ED").
Proof. reflexivity. Qed.

(** Where the recorded test is true in binary64, and t finite, they are what the real numbers say,
    and the inputs were finite. *)
Theorem quotient_value v w : agrees v w ->
  holds v RecordedQuotient.quotient_sure = true -> is_finite (eval v RecordedQuotient.quotient_t) = true ->
  truth rnd w RecordedQuotient.quotient_sure = true /\
  B2R (eval v RecordedQuotient.quotient_t) = fl w RecordedQuotient.quotient_t /\
  forall name, In name ["T1"; "T2"; "ET"; "D1"; "D2"; "ED"] -> is_finite (of_var v name) = true.
Proof.
  intros G. destruct (split_pair _ _ _ (quotient_eval v)) as [E1 E2]. rewrite E1, E2. intros S F.
  assert (K : forall x, is_finite x = true -> B2R (keep 26 x) = highest (B2R x)).
  { intros x X. apply keep_value; [lia | exact X]. }
  destruct (quotient64_real (keep 26) K (keep_finite 26) _ _ _ _ _ _ S F)
    as [V [T [H1 [H2 [H3 [H4 [H5 H6]]]]]]].
  destruct (split_pair _ _ _ (quotient_code w)) as [-> ->]. unfold var.
  rewrite !G in V, T by assumption.
  split; [exact T|]. split; [exact V|].
  intros name [<-|[<-|[<-|[<-|[<-|[<-|[]]]]]]]; assumption.
Qed.

(** The recorded expressions that [run_value] speaks of. *)
Theorem stages_plain : forallb plain [
  RecordedQuotient.two_sum_high; RecordedQuotient.two_sum_low; RecordedQuotient.halves_high; RecordedQuotient.halves_low;
  RecordedQuotient.highest; RecordedQuotient.power_above; RecordedQuotient.unit_from_point;
  RecordedQuotient.product_high; RecordedQuotient.product_low; RecordedQuotient.product_of_one_high; RecordedQuotient.product_of_one_low;
  RecordedQuotient.cross_x; RecordedQuotient.cross_y; RecordedQuotient.cross_z; RecordedQuotient.cross_M;
  RecordedQuotient.cross_low_x; RecordedQuotient.cross_low_y; RecordedQuotient.cross_low_z;
  RecordedQuotient.normal_x; RecordedQuotient.normal_y; RecordedQuotient.normal_z;
  RecordedQuotient.normal_low_x; RecordedQuotient.normal_low_y; RecordedQuotient.normal_low_z;
  RecordedQuotient.table_from_point_hx; RecordedQuotient.table_from_point_hy; RecordedQuotient.table_from_point_hz;
  RecordedQuotient.table_from_point_lx; RecordedQuotient.table_from_point_ly; RecordedQuotient.table_from_point_lz;
  RecordedQuotient.table_from_point_T1; RecordedQuotient.table_from_point_T2;
  RecordedQuotient.table_parallel_hx; RecordedQuotient.table_parallel_hy; RecordedQuotient.table_parallel_hz;
  RecordedQuotient.table_parallel_lx; RecordedQuotient.table_parallel_ly; RecordedQuotient.table_parallel_lz;
  RecordedQuotient.table_parallel_T1; RecordedQuotient.table_parallel_T2;
  RecordedQuotient.table_parallel_D1; RecordedQuotient.table_parallel_D2;
  RecordedQuotient.table_alone_hx; RecordedQuotient.table_alone_hy; RecordedQuotient.table_alone_hz;
  RecordedQuotient.table_alone_lx; RecordedQuotient.table_alone_ly; RecordedQuotient.table_alone_lz; RecordedQuotient.table_alone_size;
  RecordedQuotient.table_alone_px; RecordedQuotient.table_alone_py; RecordedQuotient.table_alone_pz;
  RecordedQuotient.meet_from_point_T1; RecordedQuotient.meet_from_point_T2; RecordedQuotient.meet_from_point_ET;
  RecordedQuotient.meet_from_point_D1; RecordedQuotient.meet_from_point_D2; RecordedQuotient.meet_from_point_ED;
  RecordedQuotient.meet_parallel_T1; RecordedQuotient.meet_parallel_T2; RecordedQuotient.meet_parallel_ET;
  RecordedQuotient.meet_parallel_D1; RecordedQuotient.meet_parallel_D2; RecordedQuotient.meet_parallel_ED;
  RecordedQuotient.meet_alone_T1; RecordedQuotient.meet_alone_T2; RecordedQuotient.meet_alone_D1; RecordedQuotient.meet_alone_D2] = true.
Proof. vm_compute. reflexivity. Qed.
