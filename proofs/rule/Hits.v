(** What the rule says of hits: [is_crossed] and [sign_of_difference] are those of the moved ray. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Small Integers Ties.
Import ListNotations.
Open Scope R_scope.

(** * One edge *)

(** What [is_crossed] asks of the edge from a to b, for an integer ray: [_sign] of the [Hit]'s entries. *)
Definition edge_sign (moves : list Integers) (o d a b : Integers) : Z :=
  let a := _sub a o in let b := _sub b o in
  _sign (_dot d (_cross a b)) (_cross a b) (_sub a b) d moves.
Notation moved_ray moves o d x y := (moved (map real moves) (real_ray o d) x y).
Lemma vscale_1 v : vscale 1 v = v.
Proof. destruct v. unfold vscale; simpl. apply V_eq; ring. Qed.

(** It is the sign of the edge function of the moved ray, for any list of moves: with the stored floats,
    which are the integers times one L for lengths and one M for directions, and so with 1 and 1. *)
Section Stored.
Variables L M : R.
Hypothesis L_pos : 0 < L.
Hypothesis M_pos : 0 < M.
Definition stored_ray o d := Ray (vscale L (real o)) (vscale M (real d)).
Theorem edge_rule_stored moves o d a b : small2 (fun x y =>
  sgn (edge (moved (map real moves) (stored_ray o d) x y) (vscale L (real a)) (vscale L (real b))) =
  edge_sign moves o d a b).
Proof.
  unfold edge_sign.
  eapply small2_mono; [| apply (sign_is_of_moved_ray (_cross (_sub a o) (_sub b o))
    (_sub (_sub a o) (_sub b o)) d moves M (L * L) L); [unfold _dot, _cross, _sub; cbn [ix iy iz]; ring | | |]; nra].
  intros x y _ _ <-. rewrite edge_moved. f_equal. unfold stored_ray; cbn [origin direction].
  rewrite !real_cross, !real_sub. f_equal; unfold vsub, cross, vscale; simpl; apply V_eq; ring.
Qed.
End Stored.
Theorem edge_rule moves o d a b : small2 (fun x y =>
  sgn (edge (moved_ray moves o d x y) (real a) (real b)) = edge_sign moves o d a b).
Proof.
  assert (H := edge_rule_stored 1 1 Rlt_0_1 Rlt_0_1 moves o d a b). unfold stored_ray in H.
  now rewrite !vscale_1 in H.
Qed.

(** Seen from the other triangle at the edge, it is the other sign: *)
Theorem edge_opposite moves o d a b : edge_sign moves o d b a = (- edge_sign moves o d a b)%Z.
Proof.
  destruct (small2_exists _ (small2_and _ _ (edge_rule moves o d a b) (edge_rule moves o d b a)))
    as (x & y & _ & _ & <- & <-).
  rewrite <- sgn_opp. f_equal. unfold edge, dot, cross, vsub; simpl; ring.
Qed.
(** and never 0, but for an edge without length. *)
Lemma zfirst_0 l : zfirst l = 0%Z <-> forall z, In z l -> z = 0%Z.
Proof.
  induction l as [|a l IH]; simpl; [tauto|]. destruct (Z.eqb_spec a 0) as [->|N].
  - rewrite IH. split; [intros H z [<-|I]; auto | auto].
  - split; [tauto | intros H; exfalso; auto].
Qed.
Lemma sign_0 m span d : _sign (_dot d m) m span d PERTURBATION = 0%Z <->
  m = ZERO /\ span = ZERO.
Proof.
  rewrite sign_is_first, Z.sgn_null_iff, zfirst_0. split.
  - intros H. assert (M : m = ZERO).
    { destruct m as [x y z]. unfold ZERO. f_equal; apply H; right; apply in_or_app; left;
        unfold _dot; cbn [map PERTURBATION ix iy iz]; [left | right; left | right; right; left]; ring. }
    split; [exact M|]. subst m. destruct span as [x y z]. unfold ZERO.
    f_equal; [| symmetry; apply Z.opp_inj; simpl; symmetry |];
      apply H; right; apply in_or_app; right; unfold rows, PERTURBATION, _dot, _cross;
      cbn [is_zero ZERO ix iy iz Z.eqb andb concat map app]; simpl In.
    + do 10 right. left. ring.
    + do 9 right. left. ring.
    + do 5 right. left. ring.
  - intros [-> ->] z I. destruct d as [a b c]. simpl in I.
    repeat (destruct I as [<-|I]; [unfold _dot, _cross; simpl; ring|]). destruct I.
Qed.
Theorem edge_never_0 o d a b : edge_sign PERTURBATION o d a b <> 0%Z <-> a <> b.
Proof.
  unfold edge_sign. rewrite sign_0. split.
  - intros H ->. apply H. unfold _cross, _sub, ZERO; simpl. split; f_equal; ring.
  - intros N [_ H]. apply N. destruct a, b, o. unfold _sub, ZERO in H; simpl in H.
    injection H as. f_equal; lia.
Qed.

(** * A triangle *)

Definition on_edge (h : Hit) : bool := existsb (Z.eqb 0) (edges h).
Definition is_crossed (moves : list Integers) (h : Hit) : bool :=
  if negb (on_edge h) then true else
  let signs := map (fun '(e, m, span) => _sign e m span (direction_ h) moves)
                   (combine (combine (edges h) (sides h)) (spans h)) in
  (forallb (Z.eqb 1) signs || forallb (Z.eqb (-1)) signs)%bool.
(** Whether a ray hits a triangle, without its clip range. *)
Definition crossed (moves : list Integers) (o d a b c : Integers) : bool :=
  match hit d o a b c with None => false | Some h => is_crossed moves h end.

Lemma crossed_signs moves o d a b c : crossed moves o d a b c = true <->
  let s := edge_sign moves o d in
  (s a b = 1 /\ s b c = 1 /\ s c a = 1)%Z \/ (s a b = -1 /\ s b c = -1 /\ s c a = -1)%Z.
Proof.
  unfold crossed, hit, _triangle, edge_sign. cbv zeta.
  set (a' := _sub a o). set (b' := _sub b o). set (c' := _sub c o).
  cbn [map]. generalize (sign_value (_dot d (_cross a' b')) (_cross a' b') (_sub a' b') d moves)
    (sign_value (_dot d (_cross b' c')) (_cross b' c') (_sub b' c') d moves)
    (sign_value (_dot d (_cross c' a')) (_cross c' a') (_sub c' a') d moves).
  set (s1 := _sign _ (_cross a' b') _ _ _). set (s2 := _sign _ (_cross b' c') _ _ _).
  set (s3 := _sign _ (_cross c' a') _ _ _). intros H1 H2 H3.
  assert (G : forall e1 e2 e3 : Z, (e1 <> 0 -> s1 = Z.sgn e1)%Z -> (e2 <> 0 -> s2 = Z.sgn e2)%Z ->
    (e3 <> 0 -> s3 = Z.sgn e3)%Z ->
    (if ((min_ [e1; e2; e3] <? 0) && (0 <? max_ [e1; e2; e3]))%Z then false
     else if negb (existsb (Z.eqb 0) [e1; e2; e3]) then true
     else (forallb (Z.eqb 1) [s1; s2; s3] || forallb (Z.eqb (-1)) [s1; s2; s3])%bool) = true <->
    (s1 = 1 /\ s2 = 1 /\ s3 = 1)%Z \/ (s1 = -1 /\ s2 = -1 /\ s3 = -1)%Z).
  { clear. intros e1 e2 e3 H1 H2 H3.
    assert (L : (min_ [e1; e2; e3] <? 0)%Z = existsb (fun e => e <? 0)%Z [e1; e2; e3]).
    { apply eq_iff_eq_true. cbn [min_ fold_right existsb]. rewrite !orb_true_iff, !Z.ltb_lt. lia. }
    assert (U : (0 <? max_ [e1; e2; e3])%Z = existsb (fun e => 0 <? e)%Z [e1; e2; e3]).
    { apply eq_iff_eq_true. cbn [max_ fold_right existsb]. rewrite !orb_true_iff, !Z.ltb_lt. lia. }
    rewrite L, U. clear L U. cbn [existsb forallb].
    assert (F : ((1 =? s1) && ((1 =? s2) && ((1 =? s3) && true)) ||
                 ((-1 =? s1) && ((-1 =? s2) && ((-1 =? s3) && true))))%Z%bool = true <->
                (s1 = 1 /\ s2 = 1 /\ s3 = 1)%Z \/ (s1 = -1 /\ s2 = -1 /\ s3 = -1)%Z).
    { rewrite orb_true_iff, !andb_true_iff, !Z.eqb_eq. clear. intuition congruence. }
    destruct e1, e2, e3; try exact F; try (rewrite H1 by discriminate); try (rewrite H2 by discriminate);
      try (rewrite H3 by discriminate); clear; simpl; intuition congruence. }
  specialize (G _ _ _ H1 H2 H3). rewrite <- G. clear G.
  match goal with |- context [if ?t then None else _] => destruct t end; [reflexivity|].
  unfold is_crossed, on_edge. cbn [edges sides spans direction_ combine map]. reflexivity.
Qed.
(** The rule's answer is the moved ray's: it passes inside the triangle. *)
Theorem crossed_rule_stored L M moves o d a b c : 0 < L -> 0 < M -> small2 (fun x y =>
  meets_inside (moved (map real moves) (stored_ray L M o d) x y)
    (Triangle (vscale L (real a)) (vscale L (real b)) (vscale L (real c))) <->
  crossed moves o d a b c = true).
Proof.
  intros HL HM. eapply small2_mono; [| exact (small2_and _ _ (edge_rule_stored L M HL HM moves o d a b)
    (small2_and _ _ (edge_rule_stored L M HL HM moves o d b c) (edge_rule_stored L M HL HM moves o d c a)))].
  intros x y _ _ (A & B & C). rewrite crossed_signs. cbv zeta. rewrite <- A, <- B, <- C.
  unfold meets_inside. cbn [ca cb cc]. now rewrite !sgn_pos, !sgn_neg.
Qed.
Theorem crossed_rule moves o d a b c : small2 (fun x y =>
  meets_inside (moved_ray moves o d x y) (real_triangle a b c) <-> crossed moves o d a b c = true).
Proof.
  assert (H := crossed_rule_stored 1 1 moves o d a b c Rlt_0_1 Rlt_0_1). unfold stored_ray in H.
  now rewrite !vscale_1 in H.
Qed.
(** One moved ray for all: whatever is proven of one real ray in general position holds of the rule. *)
Definition rule_is moves o d (s : Integers * Integers * Integers) (x y : R) : Prop :=
  let '(a, b, c) := s in let r := moved_ray moves o d x y in
  (meets_inside r (real_triangle a b c) <-> crossed moves o d a b c = true) /\
  sgn (edge r (real a) (real b)) = edge_sign moves o d a b /\
  sgn (edge r (real b) (real c)) = edge_sign moves o d b c /\
  sgn (edge r (real c) (real a)) = edge_sign moves o d c a.
Theorem crossed_rule_all moves o d l :
  small2 (fun x y => forall s, In s l -> rule_is moves o d s x y).
Proof.
  apply small2_family. intros [[a b] c] _. apply small2_and; [apply crossed_rule|].
  apply small2_and; [apply edge_rule|]. apply small2_and; apply edge_rule.
Qed.

(** * The order of two hits *)

Definition intersection (h1 h2 : Hit) : Integers * Integers :=
  let w n1 n2 := (numerator_ h1 * n2 - numerator_ h2 * n1)%Z in
  let n1 := normal_ h1 in let n2 := normal_ h2 in
  (I3 (w (ix n1) (ix n2)) (w (iy n1) (iy n2)) (w (iz n1) (iz n2)),
   if (numerator_ h1 =? 0)%Z then _cross n1 n2 else ZERO).
Definition sign_of_difference (moves : list Integers) (h1 h2 : Hit) : Z :=
  let apart := (numerator_ h1 * denominator_ h2 - numerator_ h2 * denominator_ h1)%Z in
  let sign := _sign apart (fst (intersection h1 h2)) (snd (intersection h1 h2)) (direction_ h1) moves in
  if Bool.eqb (0 <? denominator_ h1)%Z (0 <? denominator_ h2)%Z then sign else (- sign)%Z.

(** A hit of a ray on the plane through p; a triangle's is on the plane through its first corner. *)
Definition hit_on o d p (h : Hit) : Prop :=
  numerator_ h = _dot (_sub p o) (normal_ h) /\ denominator_ h = _dot d (normal_ h) /\
  direction_ h = d /\ denominator_ h <> 0%Z.
Lemma hit_on_triangle d o a b c h : hit d o a b c = Some h -> denominator_ h <> 0%Z -> hit_on o d a h.
Proof.
  unfold hit, hit_on, _triangle. match goal with |- context [if ?t then None else _] => destruct t end;
    [discriminate|]. intros [= <-] N. cbn [numerator_ denominator_ normal_ direction_] in *.
  repeat split; [| | exact N]; unfold sum, _dot, _add, _cross, _sub; simpl; ring.
Qed.
Lemma hit_on_plane d o p n : _dot d n <> 0%Z -> hit_on o d p (plane_hit d o p n).
Proof. now repeat split. Qed.

Lemma sgn_mult x y : sgn (x * y) = (sgn x * sgn y)%Z.
Proof.
  destruct (sgn_cases x) as [[-> X]|[[-> X]|[-> X]]], (sgn_cases y) as [[-> Y]|[[-> Y]|[-> Y]]];
    simpl; ((apply sgn_pos; nra) || (apply sgn_neg; nra) || (apply sgn_0; nra)).
Qed.
Lemma moved_denominator L M k moves o d n : 0 < M -> 0 < k -> _dot d n <> 0%Z ->
  small2 (fun x y => sgn (D_of (moved (map real moves) (stored_ray L M o d) x y) (vscale k (real n))) =
                     Z.sgn (_dot d n)).
Proof.
  intros HM K N. unfold D_of, moved, stored_ray. cbn [direction].
  eapply small_mono; [| apply sign_of_poly]. intros x _ H.
  apply small_always. intros y _. rewrite dot_moved, H. cbn [first].
  replace (dot (vscale M (real d)) (vscale k (real n))) with (M * k * IZR (_dot d n))
    by (rewrite real_dot; unfold dot, vscale; simpl; ring).
  apply not_0_IZR in N. rewrite Req_bool_false, sgn_scale; [apply sgn_IZR | nra|].
  apply Rmult_integral_contrapositive_currified; nra.
Qed.
(** Where T1 is not 0, the code leaves out the span; then it has no say. *)
Lemma intersection_span moves value h1 h2 d :
  _sign value (fst (intersection h1 h2)) (snd (intersection h1 h2)) d moves =
  _sign value (fst (intersection h1 h2)) (_cross (normal_ h1) (normal_ h2)) d moves.
Proof.
  unfold intersection. destruct (Z.eqb_spec (numerator_ h1) 0) as [E|N]; [reflexivity|]. cbn [fst snd].
  rewrite !sign_is_first. set (w := I3 _ _ _). destruct (is_zero w) eqn:Ew; [|reflexivity].
  apply is_zero_spec in Ew. unfold w, ZERO in Ew. injection Ew as Wx Wy Wz.
  replace (_cross (normal_ h1) (normal_ h2)) with ZERO; [reflexivity|].
  destruct h1 as [T1 ? [x y z] ? ? ? ?], h2 as [T2 ? [x' y' z'] ? ? ? ?]. simpl in *.
  unfold _cross, ZERO; simpl. f_equal; symmetry; apply (Z.mul_reg_l _ _ T1 N); rewrite Z.mul_0_r.
  - replace (_ * _)%Z with (y * (T1 * z' - T2 * z) - z * (T1 * y' - T2 * y))%Z by ring. rewrite Wy, Wz. ring.
  - replace (_ * _)%Z with (z * (T1 * x' - T2 * x) - x * (T1 * z' - T2 * z))%Z by ring. rewrite Wx, Wz. ring.
  - replace (_ * _)%Z with (x * (T1 * y' - T2 * y) - y * (T1 * x' - T2 * x))%Z by ring. rewrite Wx, Wy. ring.
Qed.
Definition t_of r p n := T_of r p n / D_of r n.
(** The rule's order is that of the moved ray's t, for any list of moves; with stored floats, and k1 and
    k2 for the normals (1 and 1 with L = M = 1; L * L of a triangle). *)
Theorem order_rule L M k1 k2 moves o d p1 h1 p2 h2 : 0 < L -> 0 < M -> 0 < k1 -> 0 < k2 ->
  hit_on o d p1 h1 -> hit_on o d p2 h2 ->
  small2 (fun x y => let r := moved (map real moves) (stored_ray L M o d) x y in
    let n1 := vscale k1 (real (normal_ h1)) in let n2 := vscale k2 (real (normal_ h2)) in
    D_of r n1 <> 0 /\ D_of r n2 <> 0 /\
    sgn (t_of r (vscale L (real p1)) n1 - t_of r (vscale L (real p2)) n2) = sign_of_difference moves h1 h2).
Proof.
  intros HL HM K1 K2 (T1 & D1 & d1 & N1) (T2 & D2 & _ & N2).
  assert (M1 := N1). assert (M2 := N2). rewrite D1 in M1. rewrite D2 in M2.
  set (m1 := normal_ h1) in *. set (m2 := normal_ h2) in *. set (w := fst (intersection h1 h2)).
  assert (E : (numerator_ h1 * denominator_ h2 - numerator_ h2 * denominator_ h1)%Z = _dot d w).
  { rewrite D1, D2. unfold w, intersection, _dot. cbn [fst ix iy iz]. fold m1 m2. ring. }
  assert (P : _dot w (_cross m1 m2) = 0%Z).
  { unfold w, intersection, _dot, _cross. cbn [fst ix iy iz]. fold m1 m2. ring. }
  assert (K : 0 < k1 * k2) by nra. assert (LK : 0 < L * (k1 * k2)) by nra.
  eapply small2_mono; [| exact (small2_and _ _ (sign_is_of_moved_ray w (_cross m1 m2) d moves _ _ _ P HM LK K)
    (small2_and _ _ (moved_denominator L M k1 moves o d m1 HM K1 M1) (moved_denominator L M k2 moves o d m2 HM K2 M2)))].
  intros x y _ _ (S & S1 & S2) r n1 n2. fold r in S1, S2. fold n1 in S1. fold n2 in S2.
  assert (A1 : D_of r n1 <> 0).
  { intros A. apply sgn_0 in A. rewrite A in S1. lia. }
  assert (A2 : D_of r n2 <> 0).
  { intros A. apply sgn_0 in A. rewrite A in S2. lia. }
  split; [exact A1|]. split; [exact A2|].
  assert (W : vscale (L * (k1 * k2)) (real w) =
    w_of (T_of (stored_ray L M o d) (vscale L (real p1)) n1) n1 (T_of (stored_ray L M o d) (vscale L (real p2)) n2) n2).
  { unfold w, intersection. cbn [fst]. fold m1 m2. rewrite T1, T2.
    unfold w_of, T_of, n1, n2, stored_ray, real, vsub, vscale, dot, _dot, _sub. cbn [origin vx vy vz ix iy iz].
    rewrite !minus_IZR, !mult_IZR, !plus_IZR, !mult_IZR, !minus_IZR. apply V_eq; ring. }
  assert (X : vscale (k1 * k2) (real (_cross m1 m2)) = cross n1 n2).
  { rewrite real_cross. unfold n1, n2, cross, vscale; simpl. apply V_eq; ring. }
  rewrite W, X in S.
  change (vscale M (real d)) with (direction (stored_ray L M o d)) in S. rewrite <- difference_moved in S. fold r in S.
  clear W X. set (q1 := vscale L (real p1)) in *. set (q2 := vscale L (real p2)) in *.
  unfold sign_of_difference. rewrite intersection_span, d1, E. fold w m1 m2. rewrite <- S.
  rewrite <- D1 in S1. rewrite <- D2 in S2. clear S.
  assert (Q : 0 < (D_of r n1 * D_of r n2) * (D_of r n1 * D_of r n2)).
  { assert (D_of r n1 * D_of r n2 <> 0) by now apply Rmult_integral_contrapositive_currified.
    nra. }
  rewrite <- (sgn_scale _ _ Q).
  replace (_ * _) with ((D_of r n1 * D_of r n2) *
    (T_of r q1 n1 * D_of r n2 - T_of r q2 n2 * D_of r n1))
    by (unfold t_of; field; auto).
  rewrite !sgn_mult, S1, S2. set (X := sgn (_ - _)). clearbody X.
  destruct (Z.ltb_spec 0 (denominator_ h1)), (Z.ltb_spec 0 (denominator_ h2)); simpl Bool.eqb; cbv iota.
  - replace (Z.sgn (denominator_ h1)) with 1%Z by lia. replace (Z.sgn (denominator_ h2)) with 1%Z by lia. lia.
  - replace (Z.sgn (denominator_ h1)) with 1%Z by lia. replace (Z.sgn (denominator_ h2)) with (-1)%Z by lia. lia.
  - replace (Z.sgn (denominator_ h1)) with (-1)%Z by lia. replace (Z.sgn (denominator_ h2)) with 1%Z by lia. lia.
  - replace (Z.sgn (denominator_ h1)) with (-1)%Z by lia. replace (Z.sgn (denominator_ h2)) with (-1)%Z by lia. lia.
Qed.

(** 0 is only for what lies in one plane, and always for that. *)
Lemma dot_0 v : dot v (V 0 0 0) = 0.
Proof. unfold dot; simpl; ring. Qed.
Lemma plane_in_plane d q n1 n2 T1 T2 : dot d n1 <> 0 -> cross n1 n2 = V 0 0 0 ->
  T1 * dot d n2 = T2 * dot d n1 -> dot q n1 = T1 -> dot q n2 = T2.
Proof.
  intros N C E Q. apply (Rmult_eq_reg_l (dot d n1)); [|exact N].
  assert (I : dot d n1 * dot q n2 - dot d n2 * dot q n1 = dot (cross d q) (cross n1 n2)).
  { unfold dot, cross; simpl; ring. }
  rewrite C, Q, dot_0 in I. lra.
Qed.
Lemma one_plane_iff d n1 n2 T1 T2 : dot d n1 <> 0 -> dot d n2 <> 0 ->
  (w_of T1 n1 T2 n2 = V 0 0 0 /\ cross n1 n2 = V 0 0 0) <->
  (forall q, dot q n1 = T1 <-> dot q n2 = T2).
Proof.
  intros N1 N2. split.
  - intros [W C] q. assert (E : T1 * dot d n2 = T2 * dot d n1).
    { assert (I : T1 * dot d n2 - T2 * dot d n1 = dot d (w_of T1 n1 T2 n2)).
      { unfold w_of, dot, vsub, vscale; simpl; ring. }
      rewrite W, dot_0 in I. lra. }
    split; [now apply (plane_in_plane d)|]. apply (plane_in_plane d); auto.
    transitivity (vscale (-1) (cross n1 n2)); [unfold cross, vscale; simpl; apply V_eq; ring|].
    rewrite C. unfold vscale; simpl. apply V_eq; ring.
  - intros H. assert (E : T1 * dot d n2 = T2 * dot d n1).
    { assert (A : dot (vscale (T1 / dot d n1) d) n1 = T1).
      { transitivity (T1 / dot d n1 * dot d n1); [unfold dot, vscale; simpl; ring | field; exact N1]. }
      apply H in A. rewrite <- A. transitivity (T1 / dot d n1 * dot d n1 * dot d n2).
      - now replace (T1 / dot d n1 * dot d n1) with T1 by (field; exact N1).
      - unfold dot, vscale; simpl; ring. }
    assert (K : forall e, dot e (cross n1 n2) = 0).
    { intros e. assert (A : dot (vscale (T1 / dot d n1) d) n1 = T1).
      { transitivity (T1 / dot d n1 * dot d n1); [unfold dot, vscale; simpl; ring | field; exact N1]. }
      assert (B : dot (vadd (vscale (T1 / dot d n1) d) (cross e n1)) n1 = T1).
      { rewrite <- A at 2. unfold dot, vadd, vscale, cross; simpl; ring. }
      apply H in A, B. transitivity (T2 - T2); [|ring]. rewrite <- B at 1. rewrite <- A.
      unfold dot, vadd, vscale, cross; simpl; ring. }
    assert (C : cross n1 n2 = V 0 0 0).
    { assert (X := K (V 1 0 0)). assert (Y := K (V 0 1 0)). assert (Z := K (V 0 0 1)).
      destruct (cross n1 n2) as [x y z]. unfold dot in *; simpl in *. apply V_eq; lra. }
    split; [|exact C].
    assert (I : vscale (dot d n1) (w_of T1 n1 T2 n2) =
      vadd (vscale T1 (cross d (cross n2 n1))) (vscale (T1 * dot d n2 - T2 * dot d n1) n1)).
    { unfold w_of, dot, vadd, vscale, vsub, cross; simpl. apply V_eq; ring. }
    replace (cross n2 n1) with (vscale (-1) (cross n1 n2)) in I by (unfold cross, vscale; simpl; apply V_eq; ring).
    rewrite C, E in I. destruct (w_of T1 n1 T2 n2) as [x y z]. unfold vscale, vadd, cross in I; simpl in I.
    injection I as X Y Z. apply V_eq; apply (Rmult_eq_reg_l (dot d n1)); try exact N1; lra.
Qed.
Lemma real_0 m : m = ZERO <-> real m = V 0 0 0.
Proof.
  split; [now intros ->|]. destruct m as [x y z]. intros H. injection H as X Y Z.
  apply eq_IZR in X, Y, Z. now subst.
Qed.
Theorem order_0 o d p1 h1 p2 h2 : hit_on o d p1 h1 -> hit_on o d p2 h2 ->
  sign_of_difference PERTURBATION h1 h2 = 0%Z <->
  forall p, dot (vsub p (real p1)) (real (normal_ h1)) = 0 <-> dot (vsub p (real p2)) (real (normal_ h2)) = 0.
Proof.
  intros (T1 & D1 & d1 & N1) (T2 & D2 & _ & N2).
  assert (M1 := N1). assert (M2 := N2). rewrite D1 in M1. rewrite D2 in M2.
  apply not_0_IZR in M1, M2. rewrite real_dot in M1, M2. apply (f_equal IZR) in T1, T2.
  rewrite real_dot, real_sub in T1, T2.
  assert (E : (numerator_ h1 * denominator_ h2 - numerator_ h2 * denominator_ h1)%Z = _dot d (fst (intersection h1 h2))).
  { rewrite D1, D2. unfold intersection, _dot. cbn [fst ix iy iz]. ring. }
  assert (S : sign_of_difference PERTURBATION h1 h2 = 0%Z <->
    fst (intersection h1 h2) = ZERO /\ _cross (normal_ h1) (normal_ h2) = ZERO).
  { unfold sign_of_difference. rewrite intersection_span, E, d1, <- (sign_0 _ _ d).
    match goal with |- context [if ?t then _ else _] => destruct t end; lia. }
  rewrite S, !real_0, real_cross. clear S E.
  assert (W : real (fst (intersection h1 h2)) =
    w_of (IZR (numerator_ h1)) (real (normal_ h1)) (IZR (numerator_ h2)) (real (normal_ h2))).
  { unfold intersection, real, w_of, vsub, vscale. cbn [fst ix iy iz vx vy vz].
    now rewrite !minus_IZR, !mult_IZR. }
  rewrite W, (one_plane_iff (real d) _ _ _ _ M1 M2), T1, T2.
  set (n1 := real (normal_ h1)) in *. set (n2 := real (normal_ h2)) in *.
  assert (V1 : forall p n q, dot (vsub p q) n = 0 <-> dot (vsub p (real o)) n = dot (vsub q (real o)) n).
  { intros p n q. unfold dot, vsub; simpl. split; lra. }
  split.
  - intros H p. now rewrite !V1, H.
  - intros H q. specialize (H (vadd q (real o))). rewrite !V1 in H.
    replace (vsub (vadd q (real o)) (real o)) with q in H; [exact H|].
    destruct q. unfold vsub, vadd; simpl. apply V_eq; ring.
Qed.
