(** The recorded stages of [quotient.py] in binary64, and why real numbers are enough for them.

    Whatever comes out finite was made without overflow, and is what the real numbers say: sums,
    products, powers of two ([Finite.finite_value]) and errors ([error_value]). The quotient's test is
    [Overflow.quotient64_real]. *)
Require Import ZArith Reals Psatz String List Bool.
From Reftrace Require Import Trees Rounding Finite Digits ScalarProduct CrossProduct Ziv Quotient Overflow.
From Reftrace Require Import QuotientCode.
From Reftrace Require RecordedQuotient.
From Flocq Require Import Core BinarySingleNaN.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.
Notation float := Trees.float.

(** ** Errors: finite, they are in range *)

Lemma error64_finite x y : is_finite (error64 x y) = true -> is_finite x = true /\ is_finite y = true.
Proof.
  unfold error64. cbv zeta. destruct (less64 _ _ && less64 _ _); [|discriminate].
  intros F. apply mult_finite in F. now apply mult_finite.
Qed.
Lemma arithmetic_no_inf v e : arithmetic e = true -> no_inf v e = true.
Proof.
  induction e; simpl; intros A; auto; try discriminate; repeat (apply andb_prop in A; destruct A as [? A]);
    rewrite ?IHe1, ?IHe2; auto.
Qed.

Theorem error_value v w unit size : agrees v w -> arithmetic unit = true -> arithmetic size = true ->
  is_finite (eval v (error_tree unit size)) = true ->
  no_inf w (error_tree unit size) = true /\
  B2R (eval v (error_tree unit size)) = fl w (error_tree unit size) /\
  is_finite (eval v unit) = true /\ is_finite (eval v size) = true.
Proof.
  intros G P1 P2 F. change (eval v (error_tree unit size)) with (error64 (eval v unit) (eval v size)) in *.
  destruct (error64_real _ _ F) as [R ->]. destruct (error64_finite _ _ F) as [F1 F2].
  rewrite (finite_value v w unit G P1 F1), (finite_value v w size G P2 F2) in *.
  assert (N : no_inf w (error_tree unit size) = true).
  { apply error_code_inf; auto using arithmetic_no_inf. }
  split; [exact N|]. split; [|now split]. symmetry. now apply error_code.
Qed.

(** Of a triangle's normal: inf, where it is too small. *)
Theorem normal_error_value v w : agrees v w -> is_finite (eval v RecordedQuotient.normal_M) = true ->
  no_inf w RecordedQuotient.normal_M = true /\ B2R (eval v RecordedQuotient.normal_M) = fl w RecordedQuotient.normal_M.
Proof.
  set (M := Mul (above (away "bx" "ax") (away "by" "ay") (away "bz" "az"))
    (above (away "cx" "ax") (away "cy" "ay") (away "cz" "az"))). intros G.
  change RecordedQuotient.normal_M with (Where (Less (Num 1 (-950)) M) M Inf).
  assert (P : arithmetic M = true) by reflexivity. clearbody M. cbn [eval holds no_inf value truth].
  fold (less64 (num 1 (-950)) (eval v M)).
  destruct least_value as [N1 N2].
  destruct (less64 _ _) eqn:L; [|discriminate]. intros F.
  apply (less64_value _ _ N1 F) in L. rewrite N2, (finite_value v w M G P F) in L.
  rewrite Rmult_1_l, Rlt_bool_true by exact L. split; [now apply arithmetic_no_inf | now apply finite_value].
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

(** The recorded expressions that [finite_value] speaks of. *)
Theorem stages_arithmetic : forallb arithmetic [
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
