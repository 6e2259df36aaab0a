(** What verify.py drops, as recorded: each surface that it drops from a square of pixels is ruled out for
    each ray in the square's box, in binary64, whatever overflows. *)
Require Import ZArith Reals Psatz String Bool List.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees Rounding Magnitude Finite Signs.
From Reftrace Require Import RecordedDropping.
From Reftrace Require Import Contest Facts Dropped RoomParts Room DroppingCode.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.

Section Square.
Variable v : env.
Notation w := (real_env v).
Notation "# e" := (B2R (eval v e)) (at level 9).
Notation known e := (BinarySingleNaN.is_finite (eval v e) = true).

(** ** From binary64 to real numbers *)

Definition box_names := ["largest"; "middlex"; "middley"; "middlez"; "halfx"; "halfy"; "halfz"].
Definition all_known := forall name, In name box_names -> BinarySingleNaN.is_finite (of_var v name) = true.
Lemma form_known f : known (value_of f) -> known (reach_of f) -> all_known.
Proof.
  unfold value_of, reach_of, error_of, away, tdot at 2 3, slope, ttimes, tabs, middle, half, vector_named.
  cbn [eval X Y Z' fst snd append]. intros F G.
  repeat match goal with
  | H : BinarySingleNaN.is_finite (Bplus mode_NE _ _) = true |- _ => apply plus_finite in H; destruct H
  | H : BinarySingleNaN.is_finite (Bmult mode_NE _ _) = true |- _ => apply mult_finite in H; destruct H
  end.
  intros name [<-|[<-|[<-|[<-|[<-|[<-|[<-|[]]]]]]]]; assumption.
Qed.

(** What is computed of a number g: its value, and how far off that may be; of a form, with some room. *)
Definition says (e : expr * expr) (g : R) : Prop :=
  known (fst e) -> known (snd e) -> Rabs (g - #(fst e)) <= #(snd e).
Definition says_well (e : expr * expr) (g : R) : Prop :=
  known (fst e) -> known (snd e) ->
  Rabs (g - #(fst e)) <= (1 - 4 * u) * #(snd e) - 8 * u * Rabs #(fst e) - bpow radix2 (-1045).
Lemma says_well_says e g : says_well e g -> says e g.
Proof.
  intros H F G. specialize (H F G). assert (U := u_pos). assert (Us := u_small).
  assert (0 <= u * Rabs #(fst e)) by (apply Rmult_le_pos; [lra | apply Rabs_pos]).
  assert (P := Rabs_pos (g - #(fst e))). assert (B := bpow_gt_0 radix2 (-1045)).
  assert (0 <= #(snd e)) by nra. assert (0 <= u * #(snd e)) by (apply Rmult_le_pos; lra). lra.
Qed.

(** r, of which the box is known to be the box. *)
Definition boxed (x y z : R) : Prop := all_known ->
  let L := r_var w "largest" in
  (Rabs (fl w (X middle)) <= L /\ Rabs (fl w (Y middle)) <= L /\ Rabs (fl w (Z' middle)) <= L) /\
  (0 <= fl w (X half) <= 4 * L /\ 0 <= fl w (Y half) <= 4 * L /\ 0 <= fl w (Z' half) <= 4 * L) /\
  Rabs (x - fl w (X middle)) <= fl w (X half) + 2 * u * L /\
  Rabs (y - fl w (Y middle)) <= fl w (Y half) + 2 * u * L /\
  Rabs (z - fl w (Z' middle)) <= fl w (Z' half) + 2 * u * L.
Lemma form_says f M x y z : good w f M -> arithmetic (value_of f) = true -> arithmetic (reach_of f) = true -> boxed x y z ->
  says_well (of_form f) (exact_at w f x y z).
Proof.
  intros [] PV PR B F G. destruct (B (form_known f F G)) as (Hm & Hh & Hx & Hy & Hz).
  cbn [fst snd of_form] in *. rewrite (finite_value v w _ (real_agrees v) PV F), (finite_value v w _ (real_agrees v) PR G).
  now apply (form_near w (real_env_floats v) f M).
Qed.

(** T - start D, and far D - T *)
Lemma both_says T D gT gD s V R : says_well T gT -> says_well D gD ->
  known (fst T) -> known (snd T) -> known (fst D) -> known (snd D) ->
  V = rnd (#(fst T) - rnd (s * #(fst D))) \/ V = - rnd (rnd (s * #(fst D)) - #(fst T)) ->
  R = rnd (#(snd T) + rnd (Rabs s * #(snd D))) ->
  Rabs (gT - s * gD - V) <= R.
Proof.
  intros HT HD F1 F2 F3 F4 EV ER. specialize (HT F1 F2). specialize (HD F3 F4).
  assert (FT := B2R_is_float (eval v (fst T))). assert (FrT := B2R_is_float (eval v (snd T))).
  set (vT := #(fst T)) in *. set (rT := #(snd T)) in *. set (vD := #(fst D)) in *. set (rD := #(snd D)) in *.
  assert (E : V = rnd (vT - rnd (s * vD))).
  { destruct EV as [-> | ->]; [reflexivity|]. rewrite <- rnd_opp. f_equal. ring. }
  subst V R. assert (U := u_pos). assert (Us := u_small). assert (N := eta_pos).
  assert (e1 := rnd_err (s * vD)).
  assert (e2 : Rabs (rnd (vT - rnd (s * vD)) - (vT - rnd (s * vD))) <= u * Rabs (vT - rnd (s * vD))).
  { unfold Rminus. apply rnd_err_sum; [exact FT | apply is_float_opp, rnd_float]. }
  set (m := rnd (s * vD)) in *. set (V := rnd (vT - m)) in *.
  assert (Ps := Rabs_pos s). assert (PvD := Rabs_pos vD). assert (PvT := Rabs_pos vT).
  assert (sv : Rabs (s * vD) = Rabs s * Rabs vD) by apply Rabs_mult.
  rewrite sv in e1.
  assert (m1 : Rabs m <= (1 + u) * (Rabs s * Rabs vD) + eta).
  { replace m with ((m - s * vD) + s * vD) by ring. eapply Rle_trans; [apply Rabs_triang|]. rewrite sv. lra. }
  assert (m2 : Rabs (vT - m) <= Rabs vT + Rabs m) by (unfold Rminus; eapply Rle_trans; [apply Rabs_triang|];
    rewrite Rabs_Ropp; lra).
  assert (D1 : Rabs (s * (gD - vD)) <= Rabs s * ((1 - 4 * u) * rD - 8 * u * Rabs vD - bpow radix2 (-1045))).
  { rewrite Rabs_mult. apply Rmult_le_compat_l; lra. }
  assert (G : Rabs (gT - s * gD - V) <= Rabs (gT - vT) + Rabs (s * (gD - vD)) + Rabs (m - s * vD) + Rabs (V -
    (vT - m))).
  { replace (gT - s * gD - V) with ((gT - vT) + - (s * (gD - vD)) + (m - s * vD) + - (V - (vT - m))) by ring.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp.
    assert (T3 := Rabs_triang ((gT - vT) + - (s * (gD - vD))) (m - s * vD)).
    assert (T4 := Rabs_triang (gT - vT) (- (s * (gD - vD)))). rewrite Rabs_Ropp in T4. lra. }
  assert (B45 : 1024 * eta <= bpow radix2 (-1045)).
  { unfold eta. replace (-1045)%Z with (-1074 + 29)%Z by lia. rewrite bpow_plus.
    change (bpow radix2 29) with 536870912. generalize (bpow_gt_0 radix2 (-1074)). lra. }
  set (t := bpow radix2 (-1045)) in *.
  assert (uvT : 0 <= u * Rabs vT) by (apply Rmult_le_pos; lra).
  assert (svD : 0 <= Rabs s * Rabs vD) by (apply Rmult_le_pos; lra).
  assert (usv : 0 <= u * (Rabs s * Rabs vD)) by (apply Rmult_le_pos; lra).
  assert (uusv := small_share _ usv).
  assert (rT0 : 0 <= rT) by (generalize (Rabs_pos (gT - vT)); nra).
  assert (uvD : 0 <= u * Rabs vD) by (apply Rmult_le_pos; lra).
  assert (rD0 : 0 <= rD) by (generalize (Rabs_pos (gD - vD)); nra).
  assert (sr0 : 0 <= Rabs s * rD) by (apply Rmult_le_pos; lra).
  assert (R1 := rnd_low _ sr0).
  assert (R2 := rnd_low_sum rT (rnd (Rabs s * rD)) FrT (rnd_float _) ltac:(generalize (rnd_pos _ sr0); lra)).
  set (m' := rnd (Rabs s * rD)) in *. set (R := rnd (rT + m')) in *.
  assert (R3 : (1 - u) * (rT + ((1 - u) * (Rabs s * rD) - eta)) <= (1 - u) * (rT + m'))
    by (apply Rmult_le_compat_l; lra).
  assert (0 <= u * rT) by (apply Rmult_le_pos; lra). assert (us := small_share _ sr0).
  assert (uus := small_share (u * (Rabs s * rD)) ltac:(lra)).
  assert (0 <= Rabs s * t) by (apply Rmult_le_pos; lra). assert (ue := small_share eta ltac:(lra)).
  assert (um : u * Rabs (vT - m) <= u * (Rabs vT + ((1 + u) * (Rabs s * Rabs vD) + eta)))
    by (apply Rmult_le_compat_l; lra).
  lra.
Qed.

Lemma start_says T D gT gD : says_well T gT -> says_well D gD ->
  says (after_start T D) (gT - r_var w "start" * gD).
Proof.
  intros HT HD. unfold says, after_start. cbn [fst snd eval]. intros F G.
  destruct (minus_finite _ _ F) as [F1 F2]. destruct (mult_finite _ _ F2) as [_ F3].
  destruct (plus_finite _ _ G) as [G1 G2]. destruct (mult_finite _ _ G2) as [_ G3].
  apply (both_says T D gT gD _ _ _ HT HD F1 G1 F3 G3).
  - left. now rewrite (minus_value _ _ F), (mult_value _ _ F2).
  - now rewrite (plus_value _ _ G), (mult_value _ _ G2), B2R_Babs.
Qed.
Lemma far_says T D gT gD last : says_well T gT -> says_well D gD ->
  (BinarySingleNaN.is_finite (of_var v "far") = true -> last = r_var w "far") ->
  says (before_far T D) (last * gD - gT).
Proof.
  intros HT HD L. unfold says, before_far. cbn [fst snd eval]. intros F G.
  destruct (minus_finite _ _ F) as [F2 F1]. destruct (mult_finite _ _ F2) as [F0 F3].
  destruct (plus_finite _ _ G) as [G2 G1]. destruct (mult_finite _ _ G2) as [_ G3].
  rewrite (L F0). set (V := B2R (Bminus mode_NE _ _)). set (R := B2R (Bplus mode_NE _ _)).
  replace (r_var w "far" * gD - gT - V) with (- (gT - r_var w "far" * gD - - V)) by ring. rewrite Rabs_Ropp.
  apply (both_says T D gT gD _ _ _ HT HD F1 G1 F3 G3).
  - right. unfold V. now rewrite (minus_value _ _ F), (mult_value _ _ F2).
  - unfold R. rewrite (plus_value _ _ G), (mult_value _ _ G2), B2R_Babs. f_equal. apply Rplus_comm.
Qed.

(** ** What is asked *)

Lemma above_right e g : says e g -> holds v (is_above e) = true -> 0 < g.
Proof.
  intros S H. unfold is_above in H. cbn [holds eval] in H. apply andb_prop in H. destruct H as [F C].
  destruct (minus_finite _ _ F) as [F1 F2]. specialize (S F1 F2).
  rewrite (Bcompare_correct prec emax _ _ F2 F1) in C. apply Rabs_le_inv in S.
  revert C. case Rcompare_spec; intros; try discriminate. lra.
Qed.
Lemma below_right e g : says e g -> holds v (is_below e) = true -> g < 0.
Proof.
  intros S H. unfold is_below in H. cbn [holds eval] in H. apply andb_prop in H. destruct H as [F C].
  destruct (minus_finite _ _ F) as [F1 F2]. specialize (S F1 F2).
  rewrite (Bcompare_correct prec emax) in C by (auto; now rewrite is_finite_Bopp). rewrite B2R_Bopp in C.
  apply Rabs_le_inv in S. revert C. case Rcompare_spec; intros; try discriminate. lra.
Qed.
Lemma never f : holds v (is_above (no_edge f)) = false /\ holds v (is_below (no_edge f)) = false.
Proof.
  assert (N : forall x, BinarySingleNaN.is_finite (eval v (Sub x (Add Inf (tdot (tabs (slope f)) half)))) =
    false).
  { intros x. destruct (BinarySingleNaN.is_finite _) eqn:F; [|reflexivity]. cbn [eval] in F.
    destruct (minus_finite _ _ F) as [_ G]. destruct (plus_finite _ _ G) as [I _]. discriminate I. }
  unfold is_above, is_below, no_edge. cbn [fst snd]. cbn [holds]. now rewrite N.
Qed.

Section Gone.
Context {T D : expr * expr} {gT gD last : R}.
Hypothesis T_says : says_well T gT.
Hypothesis D_says : says_well D gD.
Hypothesis far_is : BinarySingleNaN.is_finite (of_var v "far") = true -> last = r_var w "far".
Definition ends := [gT - r_var w "start" * gD; last * gD - gT].
Definition one_of (side : R -> Prop) (l : list R) := exists x, In x l /\ side x.
Lemma any_of_plane (side : R -> Prop) f x y z : (forall e g, says e g -> holds v (f e) = true -> side g) ->
  (forall g, holds v (f (no_edge g)) = false) ->
  holds v (any5 f (after_start T D) (before_far T D) (no_edge x) (no_edge y) (no_edge z)) = true ->
  one_of side ends.
Proof.
  intros F N H. assert (A := start_says _ _ _ _ T_says D_says).
  assert (B := far_says _ _ _ _ _ T_says D_says far_is).
  unfold any5 in H. cbn [holds] in H. rewrite !N, !orb_false_r in H. unfold ends, one_of.
  apply orb_prop in H; destruct H as [H|H]; [apply (F _ _ A) in H | apply (F _ _ B) in H]; eexists; (split;
    [|exact H]); simpl; tauto.
Qed.
Theorem plane_gone x y z x' y' z' :
  holds v (gone T D (no_edge x) (no_edge y) (no_edge z) (no_edge x') (no_edge y') (no_edge z')) = true ->
  one_of (Rlt 0) ends /\ one_of (fun x => x < 0) ends.
Proof.
  intros H. unfold gone in H. cbn [holds] in H. apply orb_prop in H. destruct H as [H|H].
  - exfalso. revert H. unfold all3. cbn [holds].
    now rewrite (proj1 (never x')), (proj2 (never x')).
  - apply andb_prop in H. destruct H as [H K].
    split.
    + apply (any_of_plane _ is_above x y z); [exact above_right | intros; apply never | exact H].
    + apply (any_of_plane _ is_below x y z); [exact below_right | intros; apply never | exact K].
Qed.
Context {e1 e2 e3 b1 b2 b3 : expr * expr} {g1 g2 g3 h1 h2 h3 : R}.
Lemma any_right (side : R -> Prop) f : says e1 g1 -> says e2 g2 -> says e3 g3 ->
  (forall e g, says e g -> holds v (f e) = true -> side g) ->
  holds v (any5 f (after_start T D) (before_far T D) e1 e2 e3) = true -> one_of side (ends ++ [g1; g2; g3]).
Proof.
  intros S1 S2 S3 F H. assert (A := start_says _ _ _ _ T_says D_says).
  assert (B := far_says _ _ _ _ _ T_says D_says far_is).
  unfold any5 in H. cbn [holds] in H. unfold ends, one_of.
  repeat (apply orb_prop in H; destruct H as [H|H]);
    first [apply (F _ _ A) in H | apply (F _ _ B) in H | apply (F _ _ S1) in H | apply (F _ _ S2) in H |
      apply (F _ _ S3) in H]; eexists; (split; [|exact H]); simpl; tauto.
Qed.
Theorem triangle_gone : says e1 g1 -> says e2 g2 -> says e3 g3 -> says b1 h1 -> says b2 h2 -> says b3 h3 ->
  holds v (gone T D e1 e2 e3 b1 b2 b3) = true ->
  (one_of (Rlt 0) (ends ++ [g1; g2; g3]) /\ one_of (fun x => x < 0) (ends ++ [g1; g2; g3])) \/
  (0 < h1 /\ 0 < h2 /\ 0 < h3) \/ (h1 < 0 /\ h2 < 0 /\ h3 < 0).
Proof.
  intros S1 S2 S3 B1 B2 B3 H. unfold gone in H. cbn [holds] in H. apply orb_prop in H. destruct H as [H|H].
  - right. apply orb_prop in H. unfold all3 in H. cbn [holds] in H.
    destruct H as [H|H]; apply andb_prop in H; destruct H as [H H3]; apply andb_prop in H;
      destruct H as [H1 H2];
      [left | right]; repeat split; first [eapply above_right; eassumption | eapply below_right; eassumption].
  - left. apply andb_prop in H. destruct H as [H K].
    split; [apply (any_right _ is_above S1 S2 S3 above_right H) | apply (any_right _ is_below S1 S2 S3
      below_right K)].
Qed.
End Gone.

(** ** Hence all that is gone is ruled out *)

Definition real_of (name : string) : vec := V (r_var w (name ++ "x")) (r_var w (name ++ "y")) (r_var w (name
  ++ "z")).
Notation corners := (Triangle (real_of "a") (real_of "b") (real_of "c")).
Section Ray.
Variables (s : surface) (o d : vec) (last : R).
Notation r := (Ray o d).
Hypothesis far_is : BinarySingleNaN.is_finite (of_var v "far") = true -> last = r_var w "far".
Lemma triangle_ruled_out {T D e1 e2 e3 b1 b2 b3} :
  shape_of s = Triangular corners ->
  says_well T (Contest.T r s) -> says_well D (Contest.D r s) ->
  says_well e1 (edge r (real_of "a") (real_of "b")) -> says_well e2 (edge r (real_of "b") (real_of "c")) ->
  says_well e3 (edge r (real_of "c") (real_of "a")) ->
  says_well b1 (beside r (real_of "q") (real_of "a")) ->
    says_well b2 (beside r (real_of "q") (real_of "b")) ->
  says_well b3 (beside r (real_of "q") (real_of "c")) ->
  holds v (gone T D e1 e2 e3 b1 b2 b3) = true -> ruled_out r s (r_var w "start") last.
Proof.
  intros Shape HT HD E1 E2 E3 B1 B2 B3 H. apply says_well_says in E1, E2, E3, B1, B2, B3.
  apply (triangle_gone HT HD far_is E1 E2 E3 B1 B2 B3) in H. unfold ruled_out, ends_and_edges. rewrite Shape.
  destruct H as [[(x & X & P) (y & Y & Q)]|H]; [left | right].
  - now exists x, y.
  - now exists (real_of "q").
Qed.
Lemma plane_ruled_out {T D x y z x' y' z'} p m :
  shape_of s = Infinite p m ->
  says_well T (Contest.T r s) -> says_well D (Contest.D r s) ->
  holds v (gone T D (no_edge x) (no_edge y) (no_edge z) (no_edge x') (no_edge y') (no_edge z')) = true ->
  ruled_out r s (r_var w "start") last.
Proof.
  intros Shape HT HD H. apply (plane_gone HT HD far_is) in H.
  destruct H as [(e & X & P) (e' & Y & Q)]. left. unfold ends_and_edges. rewrite Shape. now exists e, e'.
Qed.
End Ray.

(** ** Of the four kinds of rays and surfaces *)

Section Kinds.
Variables (s : surface) (x y z last : R).
Hypothesis box : boxed x y z.
Hypothesis far_is : BinarySingleNaN.is_finite (of_var v "far") = true -> last = r_var w "far".
Lemma form_is f M g : good w f M -> arithmetic (value_of f) = true -> arithmetic (reach_of f) = true -> g = exact_at w f x y z ->
  says_well (of_form f) g.
Proof. intros G P Q ->. now apply (form_says f M). Qed.
Ltac atoms_here := first [apply atoms_zeros | apply atoms_sub | apply atoms_named | apply atoms_neg,
  atoms_named].
Ltac good_here := first
  [ apply (good_cross w (real_env_floats v)); [tauto | atoms_here | atoms_here | atoms_here]
  | apply (good_normal w (real_env_floats v)); [tauto | atoms_here]
  | apply (good_plane w (real_env_floats v)); [tauto | atoms_here] ].
Ltac same_here Shape := (* both sides, as polynomials of the components *)
  unfold T, D; rewrite ?Shape;
    unfold exact_at, edge, beside, numerator, denominator, normal, cross, vsub, dot, real_of;
  unfold edge_point, beside_point, edge_parallel, beside_parallel, form_of_cross, of_plane, numerator_point,
    denominator_point, numerator_parallel, denominator_parallel, n, size_n, ahead, zeros, a, b, c, eye, q;
  cbn [point times vector size]; unfold tneg, tdot, tcross, tsub, vector_named;
  cbn [Geometry.origin Geometry.direction ca cb cc vx vy vz X Y Z' fst snd value append];
  change (bpow radix2 0) with 1; ring.
Ltac each_form Shape := eapply form_is; [good_here | reflexivity | reflexivity | same_here Shape].
Section Point.
Notation r := (Ray (real_of "eye") (V x y z)).
Theorem triangle_point_ruled_out : shape_of s = Triangular corners ->
  holds v gone_triangle_point = true -> ruled_out r s (r_var w "start") last.
Proof.
  intros Shape H. rewrite triangle_point_is in H. revert H.
  apply (triangle_ruled_out s (real_of "eye") (V x y z) last far_is Shape); each_form Shape.
Qed.
Theorem plane_point_ruled_out : shape_of s = Infinite (real_of "a") (real_of "b") ->
  holds v gone_plane_point = true -> ruled_out r s (r_var w "start") last.
Proof.
  intros Shape H. rewrite plane_point_is in H. revert H.
  apply (plane_ruled_out s (real_of "eye") (V x y z) last far_is _ _ Shape); each_form Shape.
Qed.
End Point.
Section Parallel.
Variable o : vec.
Hypothesis x_is : x = vx o - r_var w "eyex".
Hypothesis y_is : y = vy o - r_var w "eyey".
Hypothesis z_is : z = vz o - r_var w "eyez".
Notation d := (V (- r_var w "backx") (- r_var w "backy") (- r_var w "backz")).
Theorem triangle_parallel_ruled_out : shape_of s = Triangular corners ->
  holds v gone_triangle_parallel = true -> ruled_out (Ray o d) s (r_var w "start") last.
Proof.
  intros Shape H. rewrite triangle_parallel_is in H. revert H.
  apply (triangle_ruled_out s o d last far_is Shape);
    (eapply form_is; [good_here | reflexivity | reflexivity |]); rewrite x_is, y_is, z_is; same_here Shape.
Qed.
Theorem plane_parallel_ruled_out : shape_of s = Infinite (real_of "a") (real_of "b") ->
  holds v gone_plane_parallel = true -> ruled_out (Ray o d) s (r_var w "start") last.
Proof.
  intros Shape H. rewrite plane_parallel_is in H. revert H.
  apply (plane_ruled_out s o d last far_is _ _ Shape);
    (eapply form_is; [good_here | reflexivity | reflexivity |]); rewrite x_is, y_is, z_is; same_here Shape.
Qed.
End Parallel.
End Kinds.
End Square.
