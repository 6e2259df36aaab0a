(** What follows for surfaces: at a shared edge, around a corner and of a closed surface, the rule
    counts as one real ray does that meets neither edge nor corner. *)
Require Import ZArith Reals Psatz List Bool Permutation.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Small Integers Ties Hits.
Import ListNotations.
Open Scope R_scope.

(** * In the stored floats

    Ray and triangle as they are stored, the ray moved as the docs say: what the code decides. *)
Theorem crossed_rule_float unit direction_unit moves o d a b c : small2 (fun x y =>
  meets_inside (moved (map real moves) (float_ray unit direction_unit o d) x y)
               (float_triangle unit a b c) <-> crossed moves o d a b c = true).
Proof. exact (crossed_rule_stored _ _ moves o d a b c (bpow_gt_0 radix2 unit) (bpow_gt_0 radix2 direction_unit)). Qed.
Theorem order_rule_float unit direction_unit moves o d a b c h a' b' c' h' :
  hit d o a b c = Some h -> hit d o a' b' c' = Some h' -> denominator_ h <> 0%Z -> denominator_ h' <> 0%Z ->
  small2 (fun x y => let r := moved (map real moves) (float_ray unit direction_unit o d) x y in
    sgn (depth r (float_triangle unit a b c) - depth r (float_triangle unit a' b' c')) =
    sign_of_difference moves h h').
Proof.
  intros H H' N N'. assert (L := bpow_gt_0 radix2 unit). assert (M := bpow_gt_0 radix2 direction_unit).
  assert (LL : 0 < bpow radix2 unit * bpow radix2 unit) by nra.
  eapply small2_mono; [| exact (order_rule _ _ _ _ moves o d _ h _ h' L M LL LL
    (hit_on_triangle _ _ _ _ _ _ H N) (hit_on_triangle _ _ _ _ _ _ H' N'))].
  intros x y _ _ (_ & _ & S) r. change (stored_ray _ _ o d) with (float_ray unit direction_unit o d) in S. fold r in S.
  rewrite <- S. f_equal.
  destruct (hit_is_geometry _ _ _ _ _ _ H) as (_ & _ & -> & _), (hit_is_geometry _ _ _ _ _ _ H') as (_ & _ & -> & _).
  assert (E : forall a b c, vscale (bpow radix2 unit * bpow radix2 unit) (normal (real_triangle a b c)) =
    normal (float_triangle unit a b c)).
  { intros. unfold normal, float_triangle, real_triangle, scaled, cross, vsub, vscale; simpl. apply V_eq; ring. }
  rewrite !E. reflexivity.
Qed.

(** * Two triangles that share the edge a b, which each has in its own direction

    [s] and [s'] are the signs at their other edges. Where the triangles lie on different sides of the
    edge, s = s': one is met, not both. At a silhouette, s = -s': both or neither. *)
Theorem shared_edge o d a b c c' s s' : a <> b ->
  (s = 1 \/ s = -1)%Z -> (s' = 1 \/ s' = -1)%Z ->
  edge_sign PERTURBATION o d b c = s -> edge_sign PERTURBATION o d c a = s ->
  edge_sign PERTURBATION o d a c' = s' -> edge_sign PERTURBATION o d c' b = s' ->
  (crossed PERTURBATION o d a b c = true <->
   if (s =? s')%Z then crossed PERTURBATION o d b a c' = false else crossed PERTURBATION o d b a c' = true).
Proof.
  intros N S S' A B A' B'.
  assert (Z : edge_sign PERTURBATION o d a b <> 0%Z) by now apply edge_never_0.
  assert (P : (edge_sign PERTURBATION o d a b = 1 \/ edge_sign PERTURBATION o d a b = -1)%Z).
  { revert Z. unfold edge_sign. rewrite sign_is_first. lia. }
  assert (M := crossed_signs PERTURBATION o d a b c). assert (M' := crossed_signs PERTURBATION o d b a c').
  cbv zeta in M, M'. rewrite A, B in M. rewrite A', B', (edge_opposite _ o d a b) in M'.
  destruct S as [-> | ->], S' as [-> | ->], P as [P | P]; rewrite P in M, M'; simpl Z.eqb; cbv iota;
    rewrite ?M, <- ?not_true_iff_false, ?M'; clear; lia.
Qed.

(** * Around a corner *)

(** Seen along d: B u v > 0 where u turns to v counter-clockwise, by less than half a turn. *)
Definition B (d u v : vec) : R := dot d (cross u v).
Lemma plucker d q q' s s' : B d q q' * B d s s' = B d q s * B d q' s' - B d q s' * B d q' s.
Proof. unfold B, dot, cross; simpl; ring. Qed.

(** Steps from + to -, and how many of them there are among the first n. *)
Definition bit (b : bool) : Z := if b then 1 else 0.
Definition down (f : nat -> R) i := (Rlt_bool 0 (f i) && Rlt_bool (f (S i)) 0)%bool.
Fixpoint count (p : nat -> bool) n : Z := match n with O => 0 | S n => count p n + bit (p n) end.
Ltac signs := repeat match goal with |- context [Rlt_bool ?x ?y] => destruct (Rlt_bool_spec x y) end.

Lemma count_ext p p' n : (forall i, (i < n)%nat -> p i = p' i) -> count p n = count p' n.
Proof. induction n as [|n IH]; intros H; simpl; [easy|]. rewrite IH, H; auto. Qed.
Lemma count_telescope p p' h n : (forall i, (i < n)%nat -> bit (p i) - bit (p' i) = h (S i) - h i)%Z ->
  (count p n - count p' n = h n - h O)%Z.
Proof. induction n as [|n IH]; intros H; simpl; [lia|]. specialize (IH (fun i I => H i (le_S _ _ I))). specialize (H n). lia. Qed.
(** Around, there are as many steps down as up. *)
Theorem down_up f n : (forall i, (i <= n)%nat -> f i <> 0) -> f n = f O ->
  count (down f) n = count (down (fun i => - f i)) n.
Proof.
  intros N E. assert (T := count_telescope (down f) (down (fun i => - f i)) (fun i => bit (Rlt_bool (f i) 0)) n).
  cbv beta in T. rewrite E in T. enough (count (down f) n - count (down (fun i => (- f i)%R)) n = 0)%Z by lia.
  rewrite T; [lia|]. intros i I. unfold down. assert (A := N i (Nat.lt_le_incl _ _ I)).
  assert (C := N (S i) I). signs; simpl; try reflexivity; exfalso; lra.
Qed.

Section Around.
Variables (d : vec) (s : nat -> vec) (n : nat).
Hypothesis turns : forall i, (i < n)%nat -> 0 < B d (s i) (s (S i)).
Hypothesis closes : s n = s O.
Notation side q := (fun i => B d q (s i)).
Definition apart q := forall i, (i <= n)%nat -> B d q (s i) <> 0.

Lemma winding_turned q q' : 0 < B d q q' -> apart q -> apart q' ->
  count (down (side q)) n = count (down (side q')) n.
Proof.
  intros P A A'. set (h := fun i => bit (Rlt_bool (B d q (s i)) 0 && Rlt_bool 0 (B d q' (s i)))).
  assert (T := count_telescope (down (side q)) (down (side q')) h n).
  replace (h n) with (h O) in T by (unfold h; now rewrite closes).
  enough (count (down (side q)) n - count (down (side q')) n = 0)%Z by lia. rewrite T; [lia|].
  intros i I. unfold down, h. specialize (turns i I).
  assert (N1 := A i (Nat.lt_le_incl _ _ I)). assert (N2 := A (S i) I).
  assert (N3 := A' i (Nat.lt_le_incl _ _ I)). assert (N4 := A' (S i) I).
  assert (K := plucker d q q' (s i) (s (S i))).
  assert (G : 0 < B d q q' * B d (s i) (s (S i))) by now apply Rmult_lt_0_compat. rewrite K in G. clear K T.
  revert N1 N2 N3 N4 G. generalize (B d q (s i)) (B d q (s (S i))) (B d q' (s i)) (B d q' (s (S i))).
  intros f f1 g g1 N1 N2 N3 N4 G.
  signs; simpl; try reflexivity; exfalso; try lra; nra.
Qed.
(** However one looks out from the corner, as many rim edges are crossed: the number of times that the
    fan goes round. *)
Theorem winding q q' : apart q -> apart q' -> count (down (side q)) n = count (down (side q')) n.
Proof.
  intros A A'. destruct (Rtotal_order (B d q q') 0) as [L|[E|G]].
  - symmetry. apply winding_turned; auto. replace (B d q' q) with (- B d q q') by (unfold B, dot, cross; simpl; ring). lra.
  - assert (K : forall i, B d q (s i) * B d q' (s O) = B d q (s O) * B d q' (s i)).
    { intros i. assert (H := plucker d q q' (s i) (s O)). rewrite E in H. lra. }
    assert (N := A O (Nat.le_0_l n)). assert (N' := A' O (Nat.le_0_l n)).
    destruct (Rtotal_order 0 (B d q (s O) * B d q' (s O))) as [P|[Z|P]].
    + apply count_ext. intros i I. unfold down.
      assert (forall j, (0 < B d q (s j) <-> 0 < B d q' (s j)) /\ (B d q (s j) < 0 <-> B d q' (s j) < 0)) as H.
      { intros j. specialize (K j). repeat split; intros; nra. }
      destruct (H i) as [Hi _], (H (S i)) as [_ Hs]. signs; simpl; try reflexivity; exfalso; intuition lra.
    + symmetry in Z. apply Rmult_integral in Z. tauto.
    + rewrite down_up; [| exact A | now rewrite closes]. apply count_ext. intros i I. unfold down.
      assert (forall j, (0 < - B d q (s j) <-> 0 < B d q' (s j)) /\ (- B d q (s j) < 0 <-> B d q' (s j) < 0)) as H.
      { intros j. specialize (K j). repeat split; intros; nra. }
      destruct (H i) as [Hi _], (H (S i)) as [_ Hs]. signs; simpl; try reflexivity; exfalso; intuition lra.
  - now apply winding_turned.
Qed.
(** It goes round once: some way to look out from the corner crosses one rim edge. *)
Definition round_once := exists q, apart q /\ count (down (side q)) n = 1%Z.
End Around.

(** One triangle of such a fan is met, by any real ray that passes inside the rim and through no spoke. *)
Definition one_of (P : nat -> Prop) n := exists i, (i < n)%nat /\ P i /\ forall j, (j < n)%nat -> P j -> j = i.
Lemma count_pos p n : (0 <= count p n)%Z.
Proof. induction n as [|n IH]; simpl; [lia|]. destruct (p n); simpl; lia. Qed.
Lemma count_0 p n : count p n = 0%Z -> forall i, (i < n)%nat -> p i = false.
Proof.
  induction n as [|n IH]; simpl; [lia|]. assert (C := count_pos p n). intros H i I.
  destruct (p n) eqn:E; simpl in H; [lia|]. destruct (Nat.eq_dec i n) as [->|]; [exact E|]. apply IH; lia.
Qed.
Lemma count_1 p n : count p n = 1%Z -> one_of (fun i => p i = true) n.
Proof.
  induction n as [|n IH]; simpl; [lia|]. destruct (p n) eqn:E; simpl; intros H.
  - exists n. split; [lia|]. split; [exact E|]. intros j J P. destruct (Nat.eq_dec j n) as [|N]; [easy|].
    rewrite (count_0 p n) in P; [easy | lia | lia].
  - destruct IH as (i & I & P & U); [lia|]. exists i. split; [lia|]. split; [exact P|].
    intros j J Q. destruct (Nat.eq_dec j n) as [->|N]; [congruence|]. apply U; [lia | exact Q].
Qed.
Lemma one_of_iff P Q n : (forall i, (i < n)%nat -> P i <-> Q i) -> one_of P n -> one_of Q n.
Proof.
  intros H (i & I & Pi & U). exists i. split; [exact I|]. split; [now apply H|].
  intros j J Qj. apply U; [exact J | now apply H].
Qed.

Theorem fan r c v n : v n = v O ->
  (forall i, (i < n)%nat -> 0 < denominator r (Triangle c (v i) (v (S i)))) ->
  (forall i, (i < n)%nat -> 0 < edge r (v i) (v (S i))) ->
  (forall i, (i <= n)%nat -> edge r c (v i) <> 0) ->
  round_once (direction r) (fun i => vsub (v i) c) n ->
  one_of (fun i => meets_inside r (Triangle c (v i) (v (S i)))) n.
Proof.
  intros E D G N (q & A & Q). set (s := fun i => vsub (v i) c) in *.
  assert (A' : apart (direction r) s n (vsub c (origin r))) by exact N.
  rewrite (winding _ s n D) with (q' := vsub c (origin r)) in Q; auto; [|unfold s; now rewrite E].
  apply count_1 in Q. revert Q. apply one_of_iff. intros i I.
  change (B (direction r) (vsub c (origin r)) (s ?i)) with (edge r c (v i)).
  unfold down. change (B (direction r) (vsub c (origin r)) (s i)) with (edge r c (v i)).
  change (B (direction r) (vsub c (origin r)) (s (S i))) with (edge r c (v (S i))).
  unfold meets_inside; simpl. specialize (G i I).
  replace (edge r (v (S i)) c) with (- edge r c (v (S i))) by (unfold edge, dot, cross, vsub; simpl; ring).
  rewrite andb_true_iff. signs; intuition (try discriminate; lra).
Qed.
(** The line is the same with the direction turned round, if all D are negative. *)
Definition turn_round k r := Ray (origin r) (vscale k (direction r)).
Lemma meets_turned k r t : k = 1 \/ k = -1 -> meets_inside (turn_round k r) t <-> meets_inside r t.
Proof.
  intros K. assert (H : forall a b, edge (turn_round k r) a b = k * edge r a b).
  { intros. unfold turn_round, edge, dot, vscale; simpl; ring. }
  unfold meets_inside. rewrite !H. destruct K as [-> | ->]; intuition lra.
Qed.

(** * The rule at a corner: a ray exactly through the corner c of a fan that goes round once (seen along
    the ray, with all D of the sign k) hits one triangle of it, and only one. *)
Lemma sign_stays moves o d m : dot (real d) m <> 0 ->
  small2 (fun x y => sgn (dot (direction (moved_ray moves o d x y)) m) = sgn (dot (real d) m)).
Proof.
  intros N. unfold moved. cbn [direction real_ray].
  eapply small_mono; [| apply sign_of_poly]. intros x _ H.
  apply small_always. intros y _. rewrite dot_moved, H. cbn [first]. now rewrite Req_bool_false.
Qed.
Lemma upto_family (P : nat -> R -> R -> Prop) n : (forall i, (i <= n)%nat -> small2 (P i)) ->
  small2 (fun x y => forall i, (i <= n)%nat -> P i x y).
Proof.
  intros H. eapply small2_mono; [| apply (small2_family P (seq 0 (S n)))].
  - intros x y _ _ K i I. apply K, in_seq. lia.
  - intros i I. apply in_seq in I. apply H. lia.
Qed.
Lemma sgn_eq_sides x y : sgn x = sgn y -> Rlt_bool 0 x = Rlt_bool 0 y /\ Rlt_bool x 0 = Rlt_bool y 0.
Proof.
  intros H. destruct (sgn_cases x) as [[X P]|[[X P]|[X P]]], (sgn_cases y) as [[Y Q]|[[Y Q]|[Y Q]]];
    try congruence; split; signs; try reflexivity; exfalso; lra.
Qed.

Theorem fan_rule o d c (v : nat -> Integers) n k : k = 1 \/ k = -1 -> v n = v O -> (0 < n)%nat ->
  _cross (_sub c o) d = ZERO ->
  (forall i, (i < n)%nat ->
     0 < k * denominator (real_ray o d) (real_triangle c (v i) (v (S i)))) ->
  round_once (real d) (fun i => vsub (real (v i)) (real c)) n ->
  one_of (fun i => crossed PERTURBATION o d c (v i) (v (S i)) = true) n.
Proof.
  intros K E n0 L D (q & A & Q). set (s := fun i => vsub (real (v i)) (real c)) in *.
  apply (f_equal real) in L. rewrite real_cross, real_sub in L.
  assert (K0 : forall x, k * x <> 0 -> x <> 0) by (intros x H ->; lra).
  (* what stays as it is while the ray is moved *)
  assert (S1 := upto_family (fun i x y => sgn (B (direction (moved_ray PERTURBATION o d x y)) q (s i)) =
    sgn (B (real d) q (s i))) n (fun i I => sign_stays _ _ _ _ (A i I))).
  assert (S2 : small2 (fun x y => forall i, (i <= n)%nat -> (i < n)%nat ->
    0 < k * denominator (moved_ray PERTURBATION o d x y) (real_triangle c (v i) (v (S i))))).
  { apply upto_family. intros i _. destruct (Nat.lt_ge_cases i n) as [I|]; [|apply small2_always; intros; lia].
    specialize (D i I). unfold denominator in D at 1.
    eapply small2_mono; [| apply (sign_stays PERTURBATION o d (normal (real_triangle c (v i) (v (S i))))), K0; exact (Rgt_not_eq _ _ D)].
    intros x y _ _ H _. unfold denominator. cbn [direction real_ray] in D. destruct K as [-> | ->].
    - enough (0 < dot (direction (moved_ray PERTURBATION o d x y)) (normal (real_triangle c (v i) (v (S i))))) by lra.
      apply sgn_pos. rewrite H. apply sgn_pos. lra.
    - enough (dot (direction (moved_ray PERTURBATION o d x y)) (normal (real_triangle c (v i) (v (S i)))) < 0) by lra.
      apply sgn_neg. rewrite H. apply sgn_neg. lra. }
  assert (S3 := crossed_rule_all PERTURBATION o d (map (fun i => (c, v i, v (S i))) (seq 0 n))).
  destruct (small2_exists _ (small2_and _ _ S1 (small2_and _ _ S2 S3))) as (x & y & _ & _ & H1 & H2 & H3).
  clear S1 S2 S3. set (r := moved_ray PERTURBATION o d x y) in *.
  assert (R : forall i, (i < n)%nat -> rule_is PERTURBATION o d (c, v i, v (S i)) x y).
  { intros i I. apply H3, in_map_iff. exists i. split; [reflexivity|]. apply in_seq. lia. }
  clear H3. apply one_of_iff with (fun i => meets_inside (turn_round k r) (Triangle (real c) (real (v i)) (real (v (S i))))).
  { intros i I. rewrite (meets_turned k r _ K). apply (R i I). }
  assert (G : forall i, (i < n)%nat -> c <> v i).
  { intros i I F. specialize (D i I). rewrite <- F in D. unfold denominator, normal, dot, cross, vsub in D. simpl in D. ring_simplify in D. lra. }
  apply (fan (turn_round k r) (real c) (fun i => real (v i)) n).
  - now rewrite E.
  - intros i I. specialize (H2 i (Nat.lt_le_incl _ _ I) I).
    replace (denominator _ _) with (k * denominator r (real_triangle c (v i) (v (S i)))); [exact H2|].
    unfold denominator, turn_round, real_triangle, dot, vscale; simpl; ring.
  - intros i I. destruct (R i I) as (_ & _ & H & _). fold r in H. specialize (D i I).
    assert (F : edge (real_ray o d) (real (v i)) (real (v (S i))) =
                denominator (real_ray o d) (real_triangle c (v i) (v (S i)))).
    { rewrite denominator_sum. cbn [ca cb cc real_triangle].
      assert (Z : forall p, edge (real_ray o d) (real c) p = 0).
      { intros p. transitivity (dot (vsub (real c) p) (cross (vsub (real c) (real o)) (real d))).
        - unfold edge, dot, cross, vsub; simpl; ring.
        - rewrite L. unfold dot; simpl; ring. }
      rewrite Z. replace (edge _ (real (v (S i))) (real c)) with (- edge (real_ray o d) (real c) (real (v (S i))))
        by (unfold edge, dot, cross, vsub; simpl; ring). rewrite Z. ring. }
    assert (F' : edge_sign PERTURBATION o d (v i) (v (S i)) = sgn (edge (real_ray o d) (real (v i)) (real (v (S i))))).
    { unfold edge_sign. rewrite edge_other. unfold real_ray. cbn [direction origin].
      rewrite <- !real_sub, <- real_cross, <- real_dot, sgn_IZR. apply sign_value. intros Z.
      apply (f_equal IZR) in Z. rewrite real_dot, real_cross, !real_sub in Z.
      rewrite <- F, edge_other in D. unfold real_ray in D. cbn [direction origin] in D. rewrite Z in D. lra. }
    rewrite F', F in H. replace (edge (turn_round k r) _ _) with (k * edge r (real (v i)) (real (v (S i))))
      by (unfold edge, turn_round, dot, vscale; simpl; ring).
    destruct K as [-> | ->].
    + enough (0 < edge r (real (v i)) (real (v (S i)))) by lra. apply sgn_pos. rewrite H. apply sgn_pos. lra.
    + enough (edge r (real (v i)) (real (v (S i))) < 0) by lra. apply sgn_neg. rewrite H. apply sgn_neg. lra.
  - assert (N : forall i, (i < n)%nat -> edge (turn_round k r) (real c) (real (v i)) <> 0).
    { intros i I. destruct (R i I) as (_ & H & _). fold r in H.
      replace (edge (turn_round k r) _ _) with (k * edge r (real c) (real (v i)))
        by (unfold edge, turn_round, dot, vscale; simpl; ring).
      assert (edge r (real c) (real (v i)) <> 0); [|destruct K as [-> | ->]; lra].
      intros Z. apply sgn_0 in Z. rewrite Z in H. symmetry in H. apply edge_never_0 in H; [easy | now apply G]. }
    intros i I. destruct (Nat.eq_dec i n) as [->|]; [rewrite E; now apply N | apply N; lia].
  - exists (vscale k q).
    assert (M : forall i, B (direction (turn_round k r)) (vscale k q) (vsub (real (v i)) (real c)) = B (direction r) q (s i)).
    { intros i. transitivity ((k * k) * B (direction r) q (s i)).
      - unfold B, turn_round, s, dot, cross, vscale, vsub; simpl; ring.
      - destruct K as [-> | ->]; ring. }
    split.
    + intros i I. rewrite M. intros Z. apply sgn_0 in Z. rewrite (H1 i I) in Z. apply sgn_0 in Z. exact (A i I Z).
    + rewrite <- Q. apply count_ext. intros i I. unfold down. rewrite !M.
      destruct (sgn_eq_sides _ _ (H1 i (Nat.lt_le_incl _ _ I))) as [-> _].
      now destruct (sgn_eq_sides _ _ (H1 (S i) I)) as [_ ->].
Qed.

(** That is not empty: four triangles around (0, 0, 5), seen from the origin along +z. *)
Definition rim (i : nat) : Integers :=
  match i with 0 | 4 => I3 1 0 4 | 1 => I3 0 1 4 | 2 => I3 (-1) 0 4 | _ => I3 0 (-1) 4 end%nat.
Example fan_of_four : one_of (fun i => crossed PERTURBATION ZERO (I3 0 0 1) (I3 0 0 5) (rim i) (rim (S i)) = true) 4.
Proof.
  apply fan_rule with (k := 1); try reflexivity; [now left | lia | |].
  - intros i I. do 4 (destruct i as [|i]; [unfold denominator, normal, dot, cross, vsub; simpl; lra|]). lia.
  - exists (V 1 2 0). split.
    + intros i I. do 5 (destruct i as [|i]; [unfold B, dot, cross, vsub; simpl; lra|]). lia.
    + unfold count, down, B, dot, cross, vsub; simpl. signs; simpl; reflexivity || (exfalso; lra).
Qed.
