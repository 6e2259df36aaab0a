(** The rule for ties, as [code_answers] has it, is that of the moved ray: in stored floats. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Small Integers Ties Hits.
From Reftrace Require Contest Facts Nearby Nearest.
From Reftrace Require Import CodeAnswers CodeIntegers.
Import ListNotations.
Open Scope R_scope.

(** ** The plane of a surface, by a point and a normal *)

Definition plane_is (s : Contest.surface) (p n : vec) : Prop :=
  forall q, Contest.T q s = T_of q p n /\ Contest.D q s = D_of q n.

Lemma same_plane_if s s' p n p' n' q a b : plane_is s p n -> plane_is s' p' n' -> a <> 0 -> b <> 0 ->
  vscale a n' = vscale b n -> a * Contest.T q s' = b * Contest.T q s -> Facts.same_plane s s'.
Proof.
  intros P P' A B V T. exists (a / b). split.
  { apply Rmult_integral_contrapositive_currified; [exact A | now apply Rinv_neq_0_compat]. }
  intros q'. destruct (P q') as [E1 E2], (P' q') as [F1 F2], (P q) as [G1 _], (P' q) as [G1' _].
  rewrite E1, E2, F1, F2. rewrite G1, G1' in T. clear - A B V T.
  destruct n as [x y z], n' as [x' y' z']. unfold vscale in V; simpl in V. injection V as X Y Z.
  unfold T_of, D_of, dot, vsub in *; simpl in *.
  split; apply (Rmult_eq_reg_l b); auto.
  - transitivity (b * ((vx p - vx (origin q)) * x + (vy p - vy (origin q)) * y + (vz p - vz (origin q)) * z)
      + ((vx (origin q) - vx (origin q')) * (b * x) + (vy (origin q) - vy (origin q')) * (b * y)
        + (vz (origin q) - vz (origin q')) * (b * z))); [ring|].
    rewrite <- T, <- X, <- Y, <- Z. field. exact B.
  - transitivity (vx (direction q') * (b * x) + vy (direction q') * (b * y) + vz (direction q') * (b * z));
    [ring|].
    rewrite <- X, <- Y, <- Z. field. exact B.
Qed.

Lemma moved_ray_is r x y : moved (map real PERTURBATION) r x y = Nearby.moved_ray r (x, y).
Proof.
  rewrite moved_perturbation. unfold Nearby.moved_ray, vadd, vscale. simpl. f_equal; apply V_eq; ring.
Qed.

Lemma soon_small2 (P : R * R -> Prop) : small2 (fun x y => P (x, y)) -> Nearby.soon P.
Proof. intros H. exact H. Qed.

(** The rule says 0 of two hits only where T1 n2 = T2 n1 and n1 x n2 = 0. *)
Lemma tie_intersection o d p1 h1 p2 h2 : hit_on o d p1 h1 -> hit_on o d p2 h2 ->
  sign_of_difference PERTURBATION h1 h2 = 0%Z ->
  fst (intersection h1 h2) = ZERO /\ _cross (normal_ h1) (normal_ h2) = ZERO.
Proof.
  intros (T1 & D1 & d1 & N1) (T2 & D2 & _ & N2) H.
  assert (E : (numerator_ h1 * denominator_ h2 - numerator_ h2 * denominator_ h1)%Z = _dot d (fst (intersection
    h1 h2))).
  { rewrite D1, D2. unfold intersection, _dot. cbn [fst ix iy iz]. ring. }
  apply (sign_0 _ _ d). revert H. unfold sign_of_difference. rewrite intersection_span, E, d1.
  match goal with |- context [if ?t then _ else _] => destruct t end; lia.
Qed.

Section Batch.
Variable i : inputs.
Notation r := (stored_ray i).
Variable b : batch.
Notation o := (origin_in i b).
Notation d := (direction_in i b).
Notation L := (bpow radix2 (unit_in b)).
Notation M := (bpow radix2 (exponent_of (directions b))).
Hypothesis directions_in : in_directions i b.
Hypothesis end_is : number_of (clip_end i) <> Contest.MinusInfinity.

Lemma plane_of_hit s h : in_lengths b (reals (ray_origin i)) s -> is_stored i s -> code_hit i b s = Some h ->
  exists p k, 0 < k /\ hit_on o d p h /\ plane_is s (vscale L (real p)) (vscale k (real (normal_ h))).
Proof.
  intros I S H. destruct (code_hit_facts i b directions_in end_is s I S h H) as [N _].
  assert (E := code_hit_line _ _ _ _ H). unfold line_hit in E.
  destruct (Contest.shape_of s) as [x|p n] eqn:Sh.
  - exists (integers_of (lengths b) (ca x)), (L * L).
    assert (X := triangle_exact i b s I S x Sh).
    split; [generalize (bpow_gt_0 radix2 (unit_in b)); nra|].
    split; [eapply hit_on_triangle; eassumption|].
    destruct (hit_is_geometry _ _ _ _ _ _ E) as (_ & _ & -> & _).
    set (y := real_triangle _ _ _).
    assert (C : ca x = vscale L (real (integers_of (lengths b) (ca x)))) by exact (f_equal ca X).
    assert (Nx : normal x = vscale (L * L) (normal y)).
    { rewrite (f_equal normal X). unfold y, normal, float_triangle, real_triangle, scaled, cross, vsub,
      vscale.
      simpl. apply V_eq; ring. }
    intros q. unfold Contest.T, Contest.D. rewrite Sh, <- Nx, <- C. split; reflexivity.
  - injection E as <-. destruct (plane_exact i b s I S p n Sh) as [P Q].
    exists (integers_of (lengths b) p), (bpow radix2 (exponent_of (components n))).
    split; [apply bpow_gt_0|]. split; [now apply hit_on_plane|].
    intros q. unfold Contest.T, Contest.D. rewrite Sh. cbn [plane_hit normal_].
    change (vscale L (real (integers_of (lengths b) p))) with (scaled (unit_in b) (integers_of (lengths b)
      p)).
    change (vscale (bpow radix2 (exponent_of (components n))) (real (integers_of (components n) n)))
      with (scaled (exponent_of (components n)) (integers_of (components n) n)).
    rewrite <- P, <- Q. split; reflexivity.
Qed.

Lemma ray_is s : in_lengths b (reals (ray_origin i)) s -> r = Hits.stored_ray L M o d.
Proof. intros I. exact (ray_exact i b directions_in s I). Qed.

Theorem code_is_crossed_right s h : in_lengths b (reals (ray_origin i)) s -> is_stored i s ->
  code_hit i b s = Some h ->
  Nearby.soon (fun by_ => is_crossed PERTURBATION h = true <->
    Contest.meets_within (Nearby.moved_ray r by_) s).
Proof.
  intros I S H. apply soon_small2. assert (R := ray_is s I).
  destruct (code_hit_facts i b directions_in end_is s I S h H) as [N _].
  assert (E := code_hit_line _ _ _ _ H). unfold line_hit in E.
  unfold Contest.meets_within. destruct (Contest.shape_of s) as [x|p n] eqn:Sh.
  - assert (X := triangle_exact i b s I S x Sh).
    eapply small2_mono; [| apply (crossed_rule_stored L M PERTURBATION o d (integers_of (lengths b) (ca x))
      (integers_of (lengths b) (cb x)) (integers_of (lengths b) (cc x))); apply bpow_gt_0].
    intros u v _ _ K. rewrite <- moved_ray_is, R.
    unfold crossed in K. rewrite E in K. symmetry. rewrite X. exact K.
  - injection E as <-. destruct (plane_exact i b s I S p n Sh) as [_ Q]. cbn [plane_hit denominator_] in N.
    eapply small2_mono; [| apply (moved_denominator L M (bpow radix2 (exponent_of (components n)))
      PERTURBATION o d
      (integers_of (components n) n)); [apply bpow_gt_0 | apply bpow_gt_0 | exact N]].
    intros u v _ _ K. rewrite <- moved_ray_is, R. split; [|reflexivity]. intros _. unfold Contest.D.
      rewrite Sh.
    rewrite Q at 1. intros Z. apply sgn_0 in Z.
    change (scaled (exponent_of (components n)) (integers_of (components n) n)) with
      (vscale (bpow radix2 (exponent_of (components n))) (real (integers_of (components n) n))) in Z.
    unfold D_of in K. rewrite Z in K. lia.
Qed.

Theorem code_sign_right s s' h h' :
  in_lengths b (reals (ray_origin i)) s -> in_lengths b (reals (ray_origin i)) s' ->
  is_stored i s -> is_stored i s' -> code_hit i b s = Some h -> code_hit i b s' = Some h' ->
  Nearby.soon (fun by_ => let q := Nearby.moved_ray r by_ in
    match Z.compare (sign_of_difference PERTURBATION h h') 0 with
    | Lt => Contest.t q s < Contest.t q s'
    | Gt => Contest.t q s' < Contest.t q s
    | Eq => Facts.same_plane s s'
    end).
Proof.
  intros I I' S S' H H'. apply soon_small2. assert (R := ray_is s I).
  destruct (plane_of_hit s h I S H) as (p & k & K & P & Pl).
  destruct (plane_of_hit s' h' I' S' H') as (p' & k' & K' & P' & Pl').
  eapply small2_mono; [| apply (order_rule L M k k' PERTURBATION o d p h p' h'); auto; apply bpow_gt_0].
  intros x y _ _ [N [N' G]]. cbv zeta in *. rewrite <- R in *. rewrite moved_ray_is in *.
  set (q := Nearby.moved_ray r (x, y)) in *. unfold Contest.t.
  destruct (Pl q) as [-> ->], (Pl' q) as [-> ->]. unfold Hits.t_of in G.
  destruct (Z.compare_spec (sign_of_difference PERTURBATION h h') 0) as [Z|Z|Z].
  - destruct (tie_intersection _ _ _ _ _ _ P P' Z) as [W C].
    destruct P as (T1 & D1 & _ & N1), P' as (T2 & D2 & _ & N2).
    assert (Dr : Contest.D r s = M * k * IZR (denominator_ h)).
    { rewrite (proj2 (Pl r)), R, D1, real_dot. unfold D_of, Hits.stored_ray, dot, vscale; simpl; ring. }
    assert (Dr' : Contest.D r s' = M * k' * IZR (denominator_ h')).
    { rewrite (proj2 (Pl' r)), R, D2, real_dot. unfold D_of, Hits.stored_ray, dot, vscale; simpl; ring. }
    assert (Tr : Contest.T r s = L * k * IZR (numerator_ h)).
    { rewrite (proj1 (Pl r)), R, T1, real_dot, real_sub. unfold T_of, Hits.stored_ray, dot, vsub, vscale;
      simpl; ring. }
    assert (Tr' : Contest.T r s' = L * k' * IZR (numerator_ h')).
    { rewrite (proj1 (Pl' r)), R, T2, real_dot, real_sub. unfold T_of, Hits.stored_ray, dot, vsub, vscale;
      simpl; ring. }
    assert (Mp := bpow_gt_0 radix2 (exponent_of (directions b))).
    apply (same_plane_if s s' _ _ _ _ r (Contest.D r s) (Contest.D r s') Pl Pl').
    + rewrite Dr. apply not_0_IZR in N1. repeat apply Rmult_integral_contrapositive_currified; lra.
    + rewrite Dr'. apply not_0_IZR in N2. repeat apply Rmult_integral_contrapositive_currified; lra.
    + (* D1 n2 - D2 n1 = d x (n2 x n1) *)
      rewrite Dr, Dr', D1, D2. clear - C. destruct (normal_ h) as [a1 a2 a3], (normal_ h') as [b1 b2 b3].
      destruct d as [d1 d2 d3]. unfold _cross, ZERO in C; simpl in C. injection C as C1 C2 C3.
      unfold vscale, real, _dot; simpl.
      assert (Q : forall u v, u = v -> M * k * IZR u * k' = M * k' * IZR v * k) by (intros u v ->; ring).
      apply V_eq; rewrite <- Rmult_assoc.
      all: match goal with |- ?c * IZR ?u * ?l * IZR ?v = ?e * IZR ?w * (?m * IZR ?z) =>
        transitivity (c * IZR (u * v) * l); [rewrite mult_IZR; ring|];
        transitivity (e * IZR (w * z) * m); [|rewrite mult_IZR; ring]; apply Q end.
      all: assert (K1 := f_equal (Z.mul d1) C2); assert (K2 := f_equal (Z.mul d1) C3);
        assert (K3 := f_equal (Z.mul d2) C1); assert (K4 := f_equal (Z.mul d2) C3);
        assert (K5 := f_equal (Z.mul d3) C1); assert (K6 := f_equal (Z.mul d3) C2); lia.
    + rewrite Dr, Dr', Tr, Tr'.
      assert (E : (numerator_ h * denominator_ h' = numerator_ h' * denominator_ h)%Z).
      { rewrite D1, D2. clear - W. unfold intersection, ZERO in W; cbn [fst] in W. injection W as W1 W2 W3.
        assert (K1 := f_equal (Z.mul (ix d)) W1). assert (K2 := f_equal (Z.mul (iy d)) W2).
        assert (K3 := f_equal (Z.mul (iz d)) W3). unfold _dot. lia. }
      apply (f_equal IZR) in E. rewrite !mult_IZR in E.
      transitivity (M * k * k' * L * (IZR (numerator_ h') * IZR (denominator_ h))); [ring|]. rewrite <- E.
        ring.
  - enough (T_of q (vscale L (real p)) (vscale k (real (normal_ h))) / D_of q (vscale k (real (normal_ h))) -
      T_of q (vscale L (real p')) (vscale k' (real (normal_ h'))) / D_of q (vscale k' (real (normal_ h')))
        < 0) by lra.
    apply sgn_neg. rewrite G. revert Z. unfold sign_of_difference.
    match goal with |- context [if ?t then _ else _] => destruct t end; rewrite sign_is_first; lia.
  - enough (0 < T_of q (vscale L (real p)) (vscale k (real (normal_ h))) / D_of q (vscale k (real (normal_
    h))) -
      T_of q (vscale L (real p')) (vscale k' (real (normal_ h'))) / D_of q (vscale k' (real (normal_ h'))))
        by lra.
    apply sgn_pos. rewrite G. revert Z. unfold sign_of_difference.
    match goal with |- context [if ?t then _ else _] => destruct t end; rewrite sign_is_first; lia.
Qed.
End Batch.
