(** What ladder.py says of a ray and a surface, from their e, T and D in binary64.

    The trees are those that the bridge has recorded; that they are the forms of Forms.v is proven by
    comparing them ([reflexivity]). *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees Rounding Magnitude Finite Signs Forms Interval IntervalCode
  RecordedBounds RecordedDecisions.
Open Scope R_scope.
Open Scope string_scope.

(** ** The recorded trees are those of the theorems *)

Lemma recorded_from_point :
  from_point_ab = edge_from_point a b /\ from_point_bc = edge_from_point b c /\
  from_point_ca = edge_from_point c a /\ from_point_error = E_from_point /\
  from_point_T = T_of /\ from_point_T_error = E_T_from_point /\
  from_point_D = D_of /\ from_point_D_error = E_D_from_point.
Proof. repeat split; reflexivity. Qed.
Lemma recorded_parallel :
  parallel_ab = edge_parallel a b /\ parallel_bc = edge_parallel b c /\
  parallel_ca = edge_parallel c a /\ parallel_error = E_parallel /\
  parallel_T = T_of /\ parallel_T_error = E_T_parallel /\
  parallel_D = D_of /\ parallel_D_error = E_D_parallel.
Proof. repeat split; reflexivity. Qed.
Lemma recorded_plane :
  plane_T = T_plane /\ plane_D = D_plane /\ plane_T_error = one_T_plane /\ plane_D_error = one_D_plane.
Proof. repeat split; reflexivity. Qed.
Lemma recorded_interval :
  interval_low = interval_low_ (Var "T") (Var "ET") (Var "D") (Var "ED") /\
  interval_high = interval_high_ (Var "T") (Var "ET") (Var "D") (Var "ED").
Proof. split; reflexivity. Qed.

(** Names for numbers that were computed before. *)
Definition named (one : string) (x : float) (others : string -> float) (name : string) : float :=
  if (name =? one)%string then x else others name.
Definition given (of_var : string -> float) : env := Env of_var (fun _ => false).
Definition nothing : string -> float := fun _ => B754_nan.

(** ** [sides] *)

Lemma less_finite (x y : float) : is_finite x = true -> is_finite y = true ->
  Bcompare x y = Some Datatypes.Lt -> B2R x < B2R y.
Proof.
  intros Fx Fy C. rewrite (Bcompare_correct prec emax) in C by assumption. injection C as C.
  now apply Rcompare_Lt_inv.
Qed.

Section Sides.
Variable v : env.
Variables E e1 e2 e3 : expr.
Hypothesis B1 : bounds v E e1.
Hypothesis B2 : bounds v E e2.
Hypothesis B3 : bounds v E e3.
Notation x1 := (ex (real_env v) e1).
Notation x2 := (ex (real_env v) e2).
Notation x3 := (ex (real_env v) e3).
Definition of_sides : env :=
  given (named "e1" (eval v e1) (named "e2" (eval v e2) (named "e3" (eval v e3)
    (named "error" (eval v E) nothing)))).

Lemma extremes : is_finite (eval v E) = true ->
  let low := fmin (fmin (eval v e1) (eval v e2)) (eval v e3) in
  let high := fmax (fmax (eval v e1) (eval v e2)) (eval v e3) in
  is_finite low = true /\ B2R low = Rmin (Rmin (B2R (eval v e1)) (B2R (eval v e2))) (B2R (eval v e3)) /\
  is_finite high = true /\ B2R high = Rmax (Rmax (B2R (eval v e1)) (B2R (eval v e2))) (B2R (eval v e3)).
Proof.
  intros F low high. destruct B1 as [_ H1], B2 as [_ H2], B3 as [_ H3].
  destruct (H1 F) as [F1 _], (H2 F) as [F2 _], (H3 F) as [F3 _].
  destruct (fmin_finite _ _ F1 F2) as [Fa Va]. destruct (fmin_finite _ _ Fa F3) as [Fb Vb].
  destruct (fmax_finite _ _ F1 F2) as [Fc Vc]. destruct (fmax_finite _ _ Fc F3) as [Fd Vd].
  unfold low, high. rewrite Vb, Va, Vd, Vc. auto.
Qed.

Theorem sides_sure_right : holds of_sides sides_sure = true ->
  (0 < x1 /\ 0 < x2 /\ 0 < x3) \/ (x1 < 0 /\ x2 < 0 /\ x3 < 0).
Proof.
  assert (P := proj1 B1).
  intros H. change (holds of_sides sides_sure) with (
    (match Bcompare (eval v E) (fmin (fmin (eval v e1) (eval v e2)) (eval v e3)) with Some Datatypes.Lt => true | _ => false end) ||
    (match Bcompare (fmax (fmax (eval v e1) (eval v e2)) (eval v e3)) (Bopp (eval v E)) with Some Datatypes.Lt => true | _ => false end)) in H.
  apply orb_prop in H. destruct H as [H|H].
  - destruct (Bcompare _ _) as [[]|] eqn:C in H; try discriminate.
    assert (F : is_finite (eval v E) = true) by (eapply decided_finite; eauto).
    destruct (extremes F) as [Fl [Vl _]]. apply less_finite in C; auto. rewrite Vl in C.
    assert (PE := not_negative_value _ P F).
    destruct B1 as [_ H1], B2 as [_ H2], B3 as [_ H3].
    destruct (H1 F) as [_ [L1 _]], (H2 F) as [_ [L2 _]], (H3 F) as [_ [L3 _]].
    apply Rabs_le_inv in L1, L2, L3. left. revert C. unfold Rmin. repeat destruct Rle_dec; lra.
  - destruct (Bcompare _ _) as [[]|] eqn:C in H; try discriminate.
    assert (F : is_finite (eval v E) = true) by (eapply decided_finite; eauto).
    destruct (extremes F) as [_ [_ [Fh Vh]]]. apply less_finite in C; auto; [|now rewrite is_finite_Bopp].
    rewrite Vh, B2R_Bopp in C. assert (PE := not_negative_value _ P F).
    destruct B1 as [_ H1], B2 as [_ H2], B3 as [_ H3].
    destruct (H1 F) as [_ [L1 _]], (H2 F) as [_ [L2 _]], (H3 F) as [_ [L3 _]].
    apply Rabs_le_inv in L1, L2, L3. right. revert C. unfold Rmax. repeat destruct Rle_dec; lra.
Qed.

Theorem sides_impossible_right : holds of_sides sides_possible = false ->
  (x1 < 0 \/ x2 < 0 \/ x3 < 0) /\ (0 < x1 \/ 0 < x2 \/ 0 < x3).
Proof.
  assert (P := proj1 B1).
  intros H. change (holds of_sides sides_possible) with (negb (
    (match Bcompare (fmin (fmin (eval v e1) (eval v e2)) (eval v e3)) (Bopp (eval v E)) with Some Datatypes.Lt => true | _ => false end) &&
    (match Bcompare (eval v E) (fmax (fmax (eval v e1) (eval v e2)) (eval v e3)) with Some Datatypes.Lt => true | _ => false end))) in H.
  apply negb_false_iff, andb_prop in H. destruct H as [H K].
  destruct (Bcompare _ _) as [[]|] eqn:C in H; try discriminate.
  destruct (Bcompare _ _) as [[]|] eqn:C' in K; try discriminate.
  assert (F : is_finite (eval v E) = true) by (eapply decided_finite; eauto).
  destruct (extremes F) as [Fl [Vl [Fh Vh]]].
  apply less_finite in C; auto; [|now rewrite is_finite_Bopp]. apply less_finite in C'; auto.
  rewrite Vl, B2R_Bopp in C. rewrite Vh in C'. assert (PE := not_negative_value _ P F).
  destruct B1 as [_ H1], B2 as [_ H2], B3 as [_ H3].
  destruct (H1 F) as [_ [L1 _]], (H2 F) as [_ [L2 _]], (H3 F) as [_ [L3 _]].
  apply Rabs_le_inv in L1, L2, L3. revert C C'. unfold Rmin, Rmax. repeat destruct Rle_dec; lra.
Qed.
End Sides.

(** ** The interval, as recorded *)

Section Interval.
Variable v : env.
Variables T ET D ED : expr.
Definition of_interval : env :=
  given (named "T" (eval v T) (named "ET" (eval v ET) (named "D" (eval v D)
    (named "ED" (eval v ED) nothing)))).
Lemma recorded_low : eval of_interval interval_low = eval v (interval_low_ T ET D ED).
Proof. reflexivity. Qed.
Lemma recorded_high : eval of_interval interval_high = eval v (interval_high_ T ET D ED).
Proof. reflexivity. Qed.

Hypothesis BT : bounds v ET T.
Hypothesis BD : bounds v ED D.
Notation T0 := (ex (real_env v) T).
Notation D0 := (ex (real_env v) D).

(** An upper end that is a number says that D is not 0; and then both are right. The lower end is
    right for every t that is not negative. *)
Theorem interval_right :
  let low := eval of_interval interval_low in
  let high := eval of_interval interval_high in
  (high <> B754_infinity true /\ is_nan high = false) /\
  (is_finite high = true -> D0 <> 0 /\ T0 / D0 <= B2R high) /\
  (D0 <> 0 -> 0 <= T0 / D0 \/ is_finite high = true -> low_end low (T0 / D0)).
Proof.
  cbv zeta. rewrite recorded_low, recorded_high.
  destruct (holds v (known T ET D ED)) eqn:K.
  - destruct (known_interval v T ET D ED BT BD K) as [N [L H]].
    revert H. generalize (eval v (interval_high_ T ET D ED)). intros h H.
    split; [|split]; auto.
    + destruct h as [|[]| |]; simpl in *; split; auto; try discriminate; contradiction.
    + intros F. split; auto. destruct h; simpl in *; try discriminate; lra.
  - destruct (unknown_interval v T ET D ED BT BD K) as [-> L]. split; [|split].
    + split; [discriminate | reflexivity].
    + discriminate.
    + intros N [P|P]; [now apply L | discriminate].
Qed.
End Interval.
