(** order.py: where it says which of two surfaces is nearer, or that they lie in one plane, they do. *)
Require Import ZArith Reals Psatz List String Bool.
From Flocq Require Import Core BinarySingleNaN.
From Reftrace Require Import Geometry Trees Rounding Magnitude Signs Forms RecordedDecisions Pairs Nearer.
From Reftrace Require Contest Facts Nearest Integers Hits CodeIntegers CodeRule.
From Reftrace Require Import CodeAnswers.
Import ListNotations.
Open Scope R_scope.
Open Scope string_scope.

(** ** What was recorded *)

Definition is_0 e := Same e (Num 0 0).
Definition all_0 := Not (Or (Or (Or (Or (Not (is_0 (Var "base"))) (Not (is_0 (Var "v1"))))
  (Not (is_0 (Var "v2")))) (Not (is_0 (Var "v3")))) (Not (is_0 (Var "sign")))).
Definition sign_of e := Where (Less (Num 0 0) e) (Num 1 0) (Where (Less e (Num 0 0)) (Num (-1) 0) (Num 0 0)).
Definition order_tree x :=
  Where all_0 (Num 0 0) (Where (Less (order_error x) (Abs (order_value x)))
    (Mul (sign_of (order_value x)) (Var "sign")) (Num 1 1)).
Lemma recorded_trees : order_from_point = order_tree d /\ order_parallel = order_tree apart.
Proof. split; reflexivity. Qed.

Lemma num_rounded n e : Rabs (IZR n * bpow radix2 e) <= 1 -> B2R (num n e) = rnd (IZR n * bpow radix2 e).
Proof.
  intros H. unfold num. generalize (binary_normalize_correct prec emax _ _ mode_NE n e false).
  unfold F2R; simpl Fnum; simpl Fexp. change (round _ _ _ _) with (rnd (IZR n * bpow radix2 e)).
  rewrite Rlt_bool_true; [now intros [-> _]|].
  rewrite <- rnd_abs. apply Rle_lt_trans with (rnd 1); [now apply rnd_le|].
  rewrite rnd_id; [|rewrite <- (Rmult_1_l 1); apply float_one].
  change 1 with (bpow radix2 0). apply bpow_lt. reflexivity.
Qed.
Lemma below_1 n e bits : (bit_length n + e <= bits)%Z -> Rabs (IZR n * bpow radix2 (e - bits)) <= 1.
Proof.
  intros H. rewrite Rabs_mult, (Rabs_right (bpow _ _)) by apply Rle_ge, bpow_ge_0. rewrite <- abs_IZR.
  destruct (Digits.Zdigits_correct radix2 n) as [_ K]. apply IZR_lt in K.
  fold (bit_length n) in K. assert (P : (0 <= bit_length n)%Z) by apply Digits.Zdigits_ge_0.
  rewrite (IZR_Zpower radix2) in K by exact P.
  apply Rle_trans with (bpow radix2 (bit_length n) * bpow radix2 (e - bits)).
  - apply Rmult_le_compat_r; [apply bpow_ge_0 | lra].
  - rewrite <- bpow_plus. change 1 with (bpow radix2 0). apply bpow_le. lia.
Qed.

Lemma not_0_finite (x : float) : B2R x <> 0 -> is_finite x = true.
Proof. now destruct x. Qed.

Section Table.
Variable v : env.
Variables (base unit bits : Z) (n : Integers.Integers) (same : bool) (x : tvec).
Hypothesis x_is : x = d \/ x = apart.
Hypothesis of_base : of_var v "base" = num base (unit - bits).
Hypothesis of_v1 : of_var v "v1" = num (Integers.ix n) (- bits).
Hypothesis of_v2 : of_var v "v2" = num (Integers.iy n) (- bits).
Hypothesis of_v3 : of_var v "v3" = num (Integers.iz n) (- bits).
Hypothesis of_sign : of_var v "sign" = if same then num 1 0 else num (-1) 0.
Hypothesis enough : bits = Z.max (bit_length base + unit) (Z.max (bit_length (Integers.ix n))
    (Z.max (bit_length (Integers.iy n)) (bit_length (Integers.iz n)))).

Notation w f := (IZR (f n) * bpow radix2 (- bits)).
Definition in_table : R := IZR base * bpow radix2 (unit - bits) +
  (ex (real_env v) (X x) * w Integers.ix + ex (real_env v) (Y x) * w Integers.iy
   + ex (real_env v) (Z' x) * w Integers.iz).

Theorem table_order :
  match order_number (eval v (order_tree x)) with
  | Contest.NEARER => if same then in_table < 0 else 0 < in_table
  | Contest.FARTHER => if same then 0 < in_table else in_table < 0
  | Contest.COPLANAR => False
  | Contest.UNDECIDED => True
  end.
Proof.
  assert (NZ : holds v all_0 = false).
  { assert (S : holds v (is_0 (Var "sign")) = false).
    { unfold is_0. cbn [holds eval]. rewrite of_sign. now destruct same. }
    unfold all_0. cbn [holds]. rewrite S. cbn [negb]. now rewrite orb_true_r. }
  unfold order_tree. cbn [eval]. rewrite NZ.
  destruct (holds v (Less (order_error x) (Abs (order_value x)))) eqn:K; [|exact I].
  assert (G : forall z, (bit_length z <= bits)%Z -> B2R (num z (- bits)) = rnd (IZR z * bpow radix2 (-
    bits))).
  { intros z Hz. apply num_rounded. apply (below_1 z 0 bits). lia. }
  assert (B0 : (bit_length base + unit <= bits)%Z) by lia.
  assert (B1 : (bit_length (Integers.ix n) <= bits)%Z) by lia.
  assert (B2 : (bit_length (Integers.iy n) <= bits)%Z) by lia.
  assert (B3 : (bit_length (Integers.iz n) <= bits)%Z) by lia.
  assert (S := order_sign v (IZR base * bpow radix2 (unit - bits)) (w Integers.ix) (w Integers.iy) (w
    Integers.iz)).
  rewrite of_base, of_v1, of_v2, of_v3 in S.
  specialize (S (num_rounded _ _ (below_1 _ _ _ B0)) (G _ B1) (G _ B2) (G _ B3) x x_is K).
  cbv zeta in S. fold in_table in S. clear K G. cbn [eval]. rewrite of_sign. unfold sign_of. cbn [eval holds].
  set (y := eval v (order_value x)) in *. clearbody y.
  assert (Fy : is_finite y = true) by (apply not_0_finite; lra).
  rewrite 2!(Bcompare_correct prec emax) by auto. change (B2R (num 0 0)) with 0.
  destruct S as [[P Q]|[P Q]].
  - rewrite (Rcompare_Lt 0 (B2R y)) by exact P. destruct same; exact Q.
  - rewrite (Rcompare_Gt 0 (B2R y)) by exact P. rewrite (Rcompare_Lt (B2R y) 0) by exact P.
    destruct same; exact Q.
Qed.
End Table.

(** Where the table is 0 all, they are called coplanar. *)
Lemma empty_table v x : of_var v "base" = num 0 0 -> of_var v "v1" = num 0 0 -> of_var v "v2" = num 0 0 ->
  of_var v "v3" = num 0 0 -> of_var v "sign" = num 0 0 ->
  order_number (eval v (order_tree x)) = Contest.COPLANAR.
Proof.
  intros B V1 V2 V3 S. unfold order_tree, all_0, is_0. cbn [eval holds]. rewrite B, V1, V2, V3, S.
    reflexivity.
Qed.

Section Order.
Variable i : inputs.
Notation r := (stored_ray i).
Variables s s' : Contest.surface.
Notation b := (ordered_in i s s').
Notation L := (bpow radix2 (unit_in b)).
Notation M := (bpow radix2 (exponent_of (directions b))).
Hypothesis lengths_in : in_lengths b (first_origin i) s.
Hypothesis lengths_in' : in_lengths b (first_origin i) s'.
Hypothesis directions_in : match shared i with ParallelRays _ _ _ => in_directions i b | _ => True end.
Hypothesis stored : is_stored i s.
Hypothesis stored' : is_stored i s'.

Lemma first_origin_exact : in_lengths b (first_origin i) s ->
  first_origin i = Integers.scaled (unit_in b) (integers_of (lengths b) (first_origin i)).
Proof.
  intros I. assert (K : incl (components (first_origin i)) (lengths b)).
  { intros y Y. apply I, in_or_app. now left. }
  unfold first_origin in *. destruct (shared i); now apply CodeIntegers.stored_exact.
Qed.

Lemma first_ray_is z t0 d0 n0 : in_lengths b (first_origin i) z -> is_stored i z ->
  of_first_ray i b z = (t0, d0, n0) ->
  exists p k, 0 < k /\ CodeRule.plane_is z p (vscale k (Integers.real n0)) /\
    dot (vsub p (first_origin i)) (vscale k (Integers.real n0)) = L * k * IZR t0 /\
    d0 = Integers._dot (direction_in i b) n0.
Proof.
  intros I S H. assert (O := first_origin_exact lengths_in).
  assert (In : incl (lengths_of z) (lengths b)) by (intros y Y; apply I, in_or_app; now right).
  unfold of_first_ray in H. set (o := integers_of (lengths b) (first_origin i)) in *.
  destruct (Contest.shape_of z) as [x|p n] eqn:Sh.
  - assert (E := CodeIntegers.stored_triangle i b z In S x Sh).
    set (a := integers_of (lengths b) (ca x)) in *. set (b' := integers_of (lengths b) (cb x)) in *.
    set (c := integers_of (lengths b) (cc x)) in *.
    unfold Integers._triangle in H. injection H as <- <- <-.
    set (n0 := Integers._add _ _).
    assert (N : normal x = vscale (L * L) (Integers.real n0)).
    { rewrite (f_equal normal E). unfold n0. rewrite !Integers.real_add, !Integers.real_cross,
      !Integers.real_sub.
      unfold normal, Integers.float_triangle, Integers.scaled, cross, vsub, vadd, vscale. simpl.
      apply Integers.V_eq; ring. }
    exists (ca x), (L * L). split; [generalize (bpow_gt_0 radix2 (unit_in b)); nra|].
    split; [|split; [|reflexivity]].
    + intros q. unfold Contest.T, Contest.D. rewrite Sh, <- N. split; reflexivity.
    + rewrite (f_equal ca E), O. unfold n0.
      rewrite Integers.real_dot, !Integers.real_add, !Integers.real_cross, !Integers.real_sub.
      unfold Integers.float_triangle, Integers.scaled, dot, cross, vsub, vadd, vscale. simpl. ring.
  - injection H as <- <- <-. destruct (CodeIntegers.stored_plane i b z In S p n Sh) as [P N].
    exists p, (bpow radix2 (exponent_of (components n))). split; [apply bpow_gt_0|].
    change (vscale (bpow radix2 (exponent_of (components n))) (Integers.real (integers_of (components n) n)))
      with (Integers.scaled (exponent_of (components n)) (integers_of (components n) n)).
    split; [|split; [|reflexivity]].
    + intros q. unfold Contest.T, Contest.D. rewrite Sh, <- N. split; reflexivity.
    + rewrite P at 1. rewrite O, Integers.real_dot, Integers.real_sub.
      unfold Integers.scaled, dot, vsub, vscale. simpl. ring.
Qed.

(** What is said of T1 D2 - T2 D1 is said of t. *)
Lemma by_difference (T1 D1 T2 D2 f c : R) (same : bool) o : D1 <> 0 -> D2 <> 0 -> 0 < c ->
  f * c = T1 * D2 - T2 * D1 -> (if same then 0 < D1 * D2 else D1 * D2 < 0) ->
  match o with
  | Contest.NEARER => if same then f < 0 else 0 < f
  | Contest.FARTHER => if same then 0 < f else f < 0
  | Contest.COPLANAR => False
  | Contest.UNDECIDED => True
  end ->
  match o with
  | Contest.NEARER => T1 / D1 < T2 / D2
  | Contest.FARTHER => T2 / D2 < T1 / D1
  | Contest.COPLANAR => Facts.same_plane s s'
  | Contest.UNDECIDED => True
  end.
Proof.
  intros N1 N2 C E S. destruct o; auto; try easy; intros H; apply order_of_t; auto.
  - rewrite <- E. destruct same; [assert (f * c < 0) by nra | assert (0 < f * c) by nra]; nra.
  - replace ((T2 * D1 - T1 * D2) * (D2 * D1)) with (- (f * c) * (D1 * D2)) by (rewrite E; ring).
    destruct same; [assert (0 < f * c) by nra | assert (f * c < 0) by nra]; nra.
Qed.

Lemma combined_real by1 by2 n1 n2 (k : R) : Integers.is_zero (combined by1 by2 n1 n2) = true ->
  vscale (k * IZR by1) (Integers.real n2) = vscale (k * IZR by2) (Integers.real n1).
Proof.
  intros Z. apply Integers.is_zero_spec in Z. unfold combined, Integers.ZERO in Z. injection Z as X Y Z.
  assert (K : forall a b c e, (a * b - c * e = 0)%Z -> k * IZR a * IZR b = k * IZR c * IZR e).
  { intros a b c e H. rewrite !Rmult_assoc, <- !mult_IZR. do 2 f_equal. lia. }
  unfold vscale, Integers.real. simpl. apply Integers.V_eq; now apply K.
Qed.
Lemma scale_scale a b v : vscale a (vscale b v) = vscale (a * b) v.
Proof. unfold vscale. simpl. apply Integers.V_eq; ring. Qed.
Lemma same_signs (a b : Z) : a <> 0%Z -> b <> 0%Z ->
  if Bool.eqb (0 <? a)%Z (0 <? b)%Z then 0 < IZR a * IZR b else IZR a * IZR b < 0.
Proof.
  intros A B. rewrite <- mult_IZR.
  destruct (Z.ltb_spec 0 a), (Z.ltb_spec 0 b); simpl; apply IZR_lt; nia.
Qed.

Lemma signs_scaled c x (same : bool) : 0 < c -> (if same then 0 < x else x < 0) ->
  if same then 0 < c * x else c * x < 0.
Proof. intros C. destruct same; nra. Qed.
Lemma signs_of_D (T1 D1 T2 D2 : R) (same : bool) : 0 < T1 * D1 -> 0 < T2 * D2 ->
  (if same then 0 < T1 * T2 else T1 * T2 < 0) -> if same then 0 < D1 * D2 else D1 * D2 < 0.
Proof.
  intros P Q S. assert (0 < (T1 * T2) * (D1 * D2)) by (replace (_ * _) with ((T1 * D1) * (T2 * D2)) by
    ring; nra).
  destruct same; nra.
Qed.

Theorem code_order_right : code_order_applies i = true ->
  Contest.meets_within r s -> Contest.meets_within r s' ->
  start i < Contest.t r s -> start i < Contest.t r s' ->
  match code_order i s s' with
  | Contest.NEARER => Contest.t r s < Contest.t r s'
  | Contest.FARTHER => Contest.t r s' < Contest.t r s
  | Contest.COPLANAR => Facts.same_plane s s'
  | Contest.UNDECIDED => True
  end.
Proof.
  intros A W W' P P'. apply Nearest.within_D in W, W'.
  destruct (of_first_ray i b s) as [[t1 d1] n1] eqn:E1. destruct (of_first_ray i b s') as [[t2 d2] n2] eqn:E2.
  destruct (first_ray_is _ _ _ _ lengths_in stored E1) as (p1 & k1 & K1 & Pl1 & T1 & D1).
  destruct (first_ray_is _ _ _ _ lengths_in' stored' E2) as (p2 & k2 & K2 & Pl2 & T2 & D2).
  assert (LP := bpow_gt_0 radix2 (unit_in b)). assert (MP := bpow_gt_0 radix2 (exponent_of (directions b))).
  destruct recorded_trees as [R1 R2].
  assert (FromPoint : match shared i with ParallelRays _ _ _ => False | _ => True end -> 0 <= start i ->
    match order_number (eval (order_env i s s') order_from_point) with
    | Contest.NEARER => Contest.t r s < Contest.t r s'
    | Contest.FARTHER => Contest.t r s' < Contest.t r s
    | Contest.COPLANAR => Facts.same_plane s s'
    | Contest.UNDECIDED => True
    end).
  { intros K S0. assert (O : first_origin i = reals (ray_origin i)).
    { unfold first_origin. now destruct (shared i). }
    rewrite O in T1, T2. rewrite R1.
    assert (Tr : Contest.T r s = L * k1 * IZR t1) by (rewrite (proj1 (Pl1 r)); exact T1).
    assert (Tr' : Contest.T r s' = L * k2 * IZR t2) by (rewrite (proj1 (Pl2 r)); exact T2).
    assert (Q : forall z, Contest.D r z <> 0 -> start i < Contest.t r z -> 0 < Contest.T r z * Contest.D r z).
    { intros z N G. unfold Contest.t in G.
      replace (Contest.T r z * Contest.D r z) with (Contest.T r z / Contest.D r z * (Contest.D r z *
        Contest.D r z))
        by now field. apply Rmult_lt_0_compat; [lra | nra]. }
    assert (Q1 := Q s W P). assert (Q2 := Q s' W' P').
    assert (N1 : t1 <> 0%Z). { intros ->. rewrite Tr, Rmult_0_r in Q1. lra. }
    assert (N2 : t2 <> 0%Z). { intros ->. rewrite Tr', Rmult_0_r in Q2. lra. }
    assert (Df : difference i b s s' =
      let v := combined t1 t2 n1 n2 in
      let bits := Z.max (bit_length 0 + 0) (Z.max (bit_length (Integers.ix v))
        (Z.max (bit_length (Integers.iy v)) (bit_length (Integers.iz v)))) in
      if Integers.is_zero v then (num 0 0, F3 (num 0 0) (num 0 0) (num 0 0), num 0 0)
      else (num 0 (0 - bits), F3 (num (Integers.ix v) (- bits)) (num (Integers.iy v) (- bits))
        (num (Integers.iz v) (- bits)), if Bool.eqb (0 <? t1)%Z (0 <? t2)%Z then num 1 0 else num (-1) 0)).
    { unfold difference. rewrite E1, E2. destruct (shared i); easy. }
    unfold order_env. rewrite Df. cbv zeta. set (v := combined t1 t2 n1 n2).
    destruct (Integers.is_zero v) eqn:Z.
    - rewrite empty_table by reflexivity.
      apply (CodeRule.same_plane_if s s' _ _ _ _ r (Contest.T r s) (Contest.T r s') Pl1 Pl2); [nra | nra |
        | ring].
      rewrite Tr, Tr', !scale_scale. transitivity (vscale (L * k1 * k2 * IZR t1) (Integers.real n2)).
      + f_equal. ring.
      + unfold v in Z. rewrite (combined_real _ _ _ _ _ Z). f_equal. ring.
    - set (bits := Z.max _ _).
      match goal with |- context [eval ?env _] => assert (S := table_order env 0 0 bits v
        (Bool.eqb (0 <? t1)%Z (0 <? t2)%Z) d (or_introl eq_refl) eq_refl eq_refl eq_refl eq_refl eq_refl
          eq_refl) end.
      refine (by_difference (Contest.T r s) (Contest.D r s) (Contest.T r s') (Contest.D r s') _
        (L * (k1 * k2) * bpow radix2 bits) _ _ W W' _ _ _ S).
      + repeat apply Rmult_lt_0_compat; auto. apply bpow_gt_0.
      + rewrite Tr, Tr', (proj2 (Pl1 r)), (proj2 (Pl2 r)). unfold in_table.
        set (env0 := given _).
        change (ex (real_env env0) (X d)) with (B2R (fx (ray_direction i))).
        change (ex (real_env env0) (Y d)) with (B2R (fy (ray_direction i))).
        change (ex (real_env env0) (Z' d)) with (B2R (fz (ray_direction i))). clearbody env0.
        rewrite Rmult_0_l, bpow_opp. assert (B := bpow_gt_0 radix2 bits). unfold v, combined. cbn
          [Integers.ix Integers.iy Integers.iz].
        rewrite !minus_IZR, !mult_IZR. unfold Integers.D_of, dot, vscale, Integers.real, stored_ray, reals.
        cbn [direction vx vy vz]. field. lra.
      + apply (signs_of_D (Contest.T r s) _ (Contest.T r s') _ _ Q1 Q2).
        replace (Contest.T r s * Contest.T r s') with (L * k1 * (L * k2) * (IZR t1 * IZR t2))
          by (rewrite Tr, Tr'; ring).
        apply signs_scaled; [|now apply same_signs]. repeat apply Rmult_lt_0_compat; assumption. }
  unfold code_order, code_order_applies in *. destruct (shared i) as [reach|low high first|] eqn:K; [|
    |discriminate].
  - apply FromPoint; auto. revert A. case Rle_bool_spec; auto. discriminate.
  - clear FromPoint A. rewrite R2.
    assert (O : first_origin i = reals first) by (unfold first_origin; now rewrite K). rewrite O in T1, T2.
    assert (Dir : reals (ray_direction i) = vscale M (Integers.real (direction_in i b))).
    { apply CodeIntegers.stored_exact. exact directions_in. }
    assert (Dr : Contest.D r s = M * k1 * IZR d1).
    { rewrite (proj2 (Pl1 r)), D1, Integers.real_dot. unfold Integers.D_of, stored_ray. cbn [direction].
      rewrite Dir. unfold dot, vscale. simpl. ring. }
    assert (Dr' : Contest.D r s' = M * k2 * IZR d2).
    { rewrite (proj2 (Pl2 r)), D2, Integers.real_dot. unfold Integers.D_of, stored_ray. cbn [direction].
      rewrite Dir. unfold dot, vscale. simpl. ring. }
    assert (N1 : d1 <> 0%Z). { intros Z. apply W. rewrite Dr, Z. ring. }
    assert (N2 : d2 <> 0%Z). { intros Z. apply W'. rewrite Dr', Z. ring. }
    set (base := (t1 * d2 - t2 * d1)%Z).
    assert (Df : difference i b s s' =
      let v := combined d1 d2 n1 n2 in
      let bits := Z.max (bit_length base + unit_in b) (Z.max (bit_length (Integers.ix v))
        (Z.max (bit_length (Integers.iy v)) (bit_length (Integers.iz v)))) in
      if ((base =? 0)%Z && Integers.is_zero v)%bool then (num 0 0, F3 (num 0 0) (num 0 0) (num 0 0), num 0 0)
      else (num base (unit_in b - bits), F3 (num (Integers.ix v) (- bits)) (num (Integers.iy v) (- bits))
        (num (Integers.iz v) (- bits)), if Bool.eqb (0 <? d1)%Z (0 <? d2)%Z then num 1 0 else num (-1) 0)).
    { unfold difference. rewrite E1, E2, K. reflexivity. }
    (* at the first origin, and how far this one is from it *)
    assert (All : Contest.T r s * Contest.D r s' - Contest.T r s' * Contest.D r s =
      M * (k1 * k2) * (L * IZR base + dot (vsub (reals (ray_origin i)) (reals first))
        (Integers.real (combined d1 d2 n1 n2)))).
    { rewrite (proj1 (Pl1 r)), (proj1 (Pl2 r)), Dr, Dr'. unfold Integers.T_of, stored_ray. cbn [origin].
      transitivity ((dot (vsub p1 (reals first)) (vscale k1 (Integers.real n1)) -
          dot (vsub (reals (ray_origin i)) (reals first)) (vscale k1 (Integers.real n1))) * (M * k2 * IZR
            d2) -
        (dot (vsub p2 (reals first)) (vscale k2 (Integers.real n2)) -
          dot (vsub (reals (ray_origin i)) (reals first)) (vscale k2 (Integers.real n2))) * (M * k1 * IZR
            d1)).
      { unfold dot, vsub, vscale. cbn [vx vy vz]. ring. }
      rewrite T1, T2. unfold base, combined, Integers.real, dot, vsub, vscale.
      cbn [vx vy vz Integers.ix Integers.iy Integers.iz].
      rewrite !minus_IZR, !mult_IZR. ring. }
    unfold order_env. rewrite Df. cbv zeta. set (v := combined d1 d2 n1 n2) in *.
    destruct ((base =? 0)%Z && Integers.is_zero v)%bool eqn:Z.
    + apply andb_prop in Z. destruct Z as [Z0 Z]. apply Z.eqb_eq in Z0.
      rewrite empty_table by reflexivity.
      apply (CodeRule.same_plane_if s s' _ _ _ _ r (Contest.D r s) (Contest.D r s') Pl1 Pl2 W W').
      * rewrite Dr, Dr', !scale_scale. transitivity (vscale (M * k1 * k2 * IZR d1) (Integers.real n2)).
        { f_equal. ring. }
        unfold v in Z. rewrite (combined_real _ _ _ _ _ Z). f_equal. ring.
      * apply Integers.is_zero_spec in Z. rewrite Z, Z0 in All. unfold dot, Integers.real in All. simpl in
        All. lra.
    + set (bits := Z.max _ _).
      match goal with |- context [eval ?env _] => assert (S := table_order env base (unit_in b) bits v
        (Bool.eqb (0 <? d1)%Z (0 <? d2)%Z) apart (or_intror eq_refl) eq_refl eq_refl eq_refl eq_refl
          eq_refl eq_refl) end.
      refine (by_difference (Contest.T r s) (Contest.D r s) (Contest.T r s') (Contest.D r s') _
        (M * (k1 * k2) * bpow radix2 bits) _ _ W W' _ _ _ S).
      * repeat apply Rmult_lt_0_compat; auto. apply bpow_gt_0.
      * rewrite All. unfold in_table. set (env0 := given _).
        assert (Ex : ex (real_env env0) (X apart) = B2R (fx (ray_origin i)) - B2R (fx first)).
        { unfold env0, of_kind. rewrite K. reflexivity. }
        assert (Ey : ex (real_env env0) (Y apart) = B2R (fy (ray_origin i)) - B2R (fy first)).
        { unfold env0, of_kind. rewrite K. reflexivity. }
        assert (Ez : ex (real_env env0) (Z' apart) = B2R (fz (ray_origin i)) - B2R (fz first)).
        { unfold env0, of_kind. rewrite K. reflexivity. }
        rewrite Ex, Ey, Ez. clearbody env0. unfold Z.sub. rewrite bpow_plus, bpow_opp.
        assert (B := bpow_gt_0 radix2 bits). unfold dot, vsub, Integers.real, reals.
        cbn [vx vy vz]. field. lra.
      * replace (Contest.D r s * Contest.D r s') with (M * k1 * (M * k2) * (IZR d1 * IZR d2))
          by (rewrite Dr, Dr'; ring).
        apply signs_scaled; [|now apply same_signs]. repeat apply Rmult_lt_0_compat; assumption.
Qed.
End Order.
