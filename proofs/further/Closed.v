(** A ray in general position meets a closed surface an even number of times along its whole line; and
    so does the rule, for every ray. *)
Require Import ZArith Reals Psatz List Bool Permutation.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Small Integers Clip Ties Hits Fans.
Import ListNotations.
Open Scope R_scope.

(** * Closed: the edges of all triangles can be paired, in either direction *)

Section Edges.
Context {P : Type}.
Definition edges_of (l : list (P * P * P)) : list (P * P) :=
  flat_map (fun '(a, b, c) => [(a, b); (b, c); (c, a)]) l.
Definition same_edge (e f : P * P) := f = e \/ f = (snd e, fst e).
Definition closed (l : list (P * P * P)) : Prop :=
  exists half other, Permutation (edges_of l) (half ++ other) /\ Forall2 same_edge half other.

Definition odd {A} (p : A -> bool) (l : list A) : bool := fold_right (fun a b => xorb (p a) b) false l.
Lemma odd_app {A} (p : A -> bool) l m : odd p (l ++ m) = xorb (odd p l) (odd p m).
Proof. induction l as [|a l IH]; simpl; [now destruct (odd p m)|]. rewrite IH. now rewrite xorb_assoc. Qed.
Lemma odd_permutation {A} (p : A -> bool) l m : Permutation l m -> odd p l = odd p m.
Proof.
  induction 1; simpl; try congruence. now rewrite <- !xorb_assoc, (xorb_comm (p y)).
Qed.
Lemma odd_count {A} (p : A -> bool) l : odd p l = Nat.odd (length (filter p l)).
Proof.
  induction l as [|a l IH]; simpl; [easy|]. rewrite IH. destruct (p a); simpl; [|now destruct (Nat.odd _)].
  rewrite Nat.odd_succ. unfold Nat.odd. now destruct (Nat.even _).
Qed.
(** What is asked of an edge, whichever way round, has the answer yes an even number of times. *)
Lemma closed_even l (p : P * P -> bool) : (forall a b, In (a, b) (edges_of l) -> p (b, a) = p (a, b)) ->
  closed l -> odd p (edges_of l) = false.
Proof.
  intros S (half & other & Pm & F). rewrite (odd_permutation _ _ _ Pm), odd_app.
  assert (I : forall e, In e half -> In e (edges_of l)).
  { intros e I. apply (Permutation_in _ (Permutation_sym Pm)), in_or_app. now left. }
  clear Pm. induction F as [|[a b] f half other E F IH]; simpl; [easy|].
  assert (p f = p (a, b)) as ->.
  { destruct E as [-> | ->]; [easy|]. apply S, I. now left. }
  assert (H := IH (fun e J => I e (or_intror J))). revert H.
  destruct (p (a, b)), (odd p half), (odd p other); easy.
Qed.
Lemma odd_edges l (p : P * P -> bool) (q : P * P * P -> bool) :
  (forall a b c, In (a, b, c) l -> q (a, b, c) = xorb (p (a, b)) (xorb (p (b, c)) (p (c, a)))) ->
  odd q l = odd p (edges_of l).
Proof.
  induction l as [|[[a b] c] l IH]; intros H; [easy|]. simpl. rewrite (H a b c) by now left.
  rewrite IH by (intros; apply H; now right). now rewrite !xorb_assoc.
Qed.
Lemma in_edges a b c l : In (a, b, c) l ->
  In (a, b) (edges_of l) /\ In (b, c) (edges_of l) /\ In (c, a) (edges_of l).
Proof.
  intros I. repeat split; apply in_flat_map; exists (a, b, c); simpl; tauto.
Qed.
End Edges.

(** * A real ray in general position *)

Definition plus x := Rlt_bool 0 x.
Lemma plus_mult x y : x <> 0 -> y <> 0 -> plus (x * y) = negb (xorb (plus x) (plus y)).
Proof.
  intros X Y. unfold plus. destruct (Rlt_bool_spec 0 x), (Rlt_bool_spec 0 y), (Rlt_bool_spec 0 (x * y));
    simpl; try reflexivity; exfalso; nra.
Qed.
Lemma sum_not_one_sign x y z : x <> 0 -> y <> 0 -> z <> 0 -> x + y + z = 0 ->
  ~ (plus x = plus y /\ plus y = plus z).
Proof.
  unfold plus. intros X Y Z E. destruct (Rlt_bool_spec 0 x), (Rlt_bool_spec 0 y), (Rlt_bool_spec 0 z);
    intros [A C]; try discriminate; lra.
Qed.

(** Seen along the ray, draw a line from it towards q: it crosses the edge a b or not. *)
Definition side_of r q p := B (direction r) q (vsub p (origin r)).
Definition crossed r q (e : vec * vec) : bool :=
  let (a, b) := e in
  (xorb (plus (side_of r q a)) (plus (side_of r q b)) &&
   xorb (plus (side_of r q a)) (plus (edge r a b)))%bool.
Definition inside r (t : vec * vec * vec) : bool :=
  let '(a, b, c) := t in
  (eqb (plus (edge r a b)) (plus (edge r b c)) && eqb (plus (edge r b c)) (plus (edge r c a)))%bool.
Lemma edge_back r a b : edge r b a = - edge r a b.
Proof. unfold edge, dot, cross, vsub; simpl; ring. Qed.
Lemma plus_opp x : x <> 0 -> plus (- x) = negb (plus x).
Proof. intros X. unfold plus. destruct (Rlt_bool_spec 0 x), (Rlt_bool_spec 0 (- x)); simpl; try reflexivity; exfalso; lra. Qed.
Lemma crossed_back r q a b : edge r a b <> 0 -> crossed r q (b, a) = crossed r q (a, b).
Proof.
  intros N. unfold crossed. rewrite edge_back, plus_opp by exact N.
  now destruct (plus (side_of r q a)), (plus (side_of r q b)), (plus (edge r a b)).
Qed.
(** A triangle is met where its boundary is crossed an odd number of times. *)
Lemma inside_crossed r q a b c :
  side_of r q a <> 0 -> side_of r q b <> 0 -> side_of r q c <> 0 ->
  edge r a b <> 0 -> edge r b c <> 0 -> edge r c a <> 0 ->
  inside r (a, b, c) = xorb (crossed r q (a, b)) (xorb (crossed r q (b, c)) (crossed r q (c, a))).
Proof.
  intros A C E X Y Z.
  assert (S : side_of r q a * edge r b c + side_of r q b * edge r c a + side_of r q c * edge r a b = 0).
  { unfold side_of, B, edge, dot, cross, vsub; simpl; ring. }
  assert (M : forall x y, x <> 0 -> y <> 0 -> x * y <> 0) by (intros; now apply Rmult_integral_contrapositive_currified).
  apply sum_not_one_sign in S; auto. rewrite !plus_mult in S by assumption.
  unfold inside, crossed.
  destruct (plus (side_of r q a)), (plus (side_of r q b)), (plus (side_of r q c)),
    (plus (edge r a b)), (plus (edge r b c)), (plus (edge r c a)); simpl in *; try reflexivity;
    exfalso; apply S; split; reflexivity.
Qed.
Lemma inside_meets r a b c : edge r a b <> 0 -> edge r b c <> 0 -> edge r c a <> 0 ->
  inside r (a, b, c) = true <-> meets_inside r (Triangle a b c).
Proof.
  intros X Y Z. unfold inside, meets_inside, plus. simpl.
  destruct (Rlt_bool_spec 0 (edge r a b)), (Rlt_bool_spec 0 (edge r b c)), (Rlt_bool_spec 0 (edge r c a));
    simpl; split; intros; try discriminate; try reflexivity; exfalso + idtac; lra.
Qed.
(** There is a q to which no corner is in line. *)
Lemma some_q r (ps : list vec) : (forall p, In p ps -> exists p', edge r p p' <> 0) ->
  exists q, forall p, In p ps -> side_of r q p <> 0.
Proof.
  intros H. set (axes := [V 1 0 0; V 0 1 0; V 0 0 1]).
  enough (K : small (fun x => forall p, In p ps -> side_of r (path axes x) p <> 0)).
  { apply small_exists in K. destruct K as (x & _ & K). eauto. }
  apply (small_family (fun p x => side_of r (path axes x) p <> 0)). intros p I.
  destruct (H p I) as (p' & N). set (m := cross (vsub p (origin r)) (direction r)).
  assert (F : first (map (fun u => dot u m) axes) <> 0).
  { intros F. assert (A := proj1 (first_all _) F). apply N.
    assert (X := A (dot (V 1 0 0) m) (or_introl eq_refl)).
    assert (Y := A (dot (V 0 1 0) m) (or_intror (or_introl eq_refl))).
    assert (Z := A (dot (V 0 0 1) m) (or_intror (or_intror (or_introl eq_refl)))).
    transitivity (- dot (vsub p' (origin r)) m).
    - unfold m, edge, dot, cross, vsub; simpl; ring.
    - destruct m as [x y z]. unfold dot in *. simpl in *.
      replace x with 0 by lra. replace y with 0 by lra. replace z with 0 by lra. ring. }
  eapply small_mono; [| apply (sign_of_poly (map (fun u => dot u m) axes))].
  intros x X S Z. apply F, sgn_0. rewrite <- S, <- dot_path. apply sgn_0. rewrite <- Z.
  unfold side_of, B, m, dot, cross, vsub; simpl; ring.
Qed.

Theorem closed_surface r (l : list (vec * vec * vec)) : closed l ->
  (forall a b, In (a, b) (edges_of l) -> edge r a b <> 0) ->
  Nat.even (length (filter (inside r) l)) = true.
Proof.
  intros C N. destruct (some_q r (map fst (edges_of l))) as (q & Q).
  { intros p I. apply in_map_iff in I. destruct I as ([a b] & <- & I). exists b. now apply N. }
  assert (Q' : forall a b, In (a, b) (edges_of l) -> side_of r q a <> 0).
  { intros a b I. apply Q, in_map_iff. now exists (a, b). }
  assert (E : odd (inside r) l = false).
  { rewrite (odd_edges l (crossed r q)).
    - apply closed_even; [|exact C]. intros a b I. apply crossed_back, N, I.
    - intros a b c I. destruct (in_edges _ _ _ _ I) as (I1 & I2 & I3).
      apply inside_crossed; eauto. }
  rewrite odd_count in E. rewrite <- Nat.negb_odd, E. reflexivity.
Qed.

(** * The rule, for any ray at all: so many triangles of a closed surface are hit, along the whole line.

    [Hits.crossed] is what the code decides before it looks at D and the clip range. *)
Definition met_of o d (t : Integers * Integers * Integers) : bool :=
  let '(a, b, c) := t in Hits.crossed PERTURBATION o d a b c.
Definition reals (t : Integers * Integers * Integers) : vec * vec * vec :=
  let '(a, b, c) := t in (real a, real b, real c).
Lemma edges_reals l : edges_of (map reals l) = map (fun e => (real (fst e), real (snd e))) (edges_of l).
Proof. induction l as [|[[a b] c] l IH]; [easy|]. simpl. now rewrite IH. Qed.
Theorem closed_surface_rule o d (l : list (Integers * Integers * Integers)) : closed l ->
  (forall a b, In (a, b) (edges_of l) -> a <> b) ->
  Nat.even (length (filter (met_of o d) l)) = true.
Proof.
  intros (half & other & Pm & F) N.
  destruct (small2_exists _ (crossed_rule_all PERTURBATION o d l)) as (x & y & _ & _ & R).
  set (r := moved_ray PERTURBATION o d x y) in *.
  assert (G : forall a b, In (a, b) (edges_of l) -> edge r (real a) (real b) <> 0).
  { intros a b I Z. assert (Nab := N a b I). apply in_flat_map in I. destruct I as ([[u v] w] & I & J).
    apply sgn_0 in Z. destruct (R _ I) as (_ & R1 & R2 & R3). fold r in R1, R2, R3.
    simpl in J. destruct J as [J|[J|[J|[]]]]; injection J as -> ->;
      [rewrite Z in R1; symmetry in R1; revert R1 | rewrite Z in R2; symmetry in R2; revert R2
       | rewrite Z in R3; symmetry in R3; revert R3]; now apply edge_never_0. }
  assert (K : Nat.even (length (filter (inside r) (map reals l))) = true).
  { apply closed_surface.
    - exists (map (fun e => (real (fst e), real (snd e))) half), (map (fun e => (real (fst e), real (snd e))) other).
      rewrite edges_reals, <- map_app. split; [now apply Permutation_map|].
      clear - F. induction F as [|e f half other E F IH]; simpl; constructor; [|exact IH].
      destruct E as [-> | ->]; [now left | now right].
    - intros a b I. rewrite edges_reals in I. apply in_map_iff in I. destruct I as ([u v] & E & I).
      simpl in E. injection E as <- <-. now apply G. }
  rewrite <- K. f_equal.
  assert (M : forall t, In t l -> met_of o d t = inside r (reals t)).
  { intros [[a b] c] I. destruct (in_edges _ _ _ _ I) as (I1 & I2 & I3).
    destruct (R _ I) as (S & _). fold r in S. apply eq_iff_eq_true. unfold met_of, reals.
    rewrite inside_meets; [symmetry; exact S | | |]; now apply G. }
  clear - M. induction l as [|t l IH]; simpl; [easy|]. rewrite M by now left.
  assert (H := IH (fun t I => M t (or_intror I))). destruct (inside r (reals t)); simpl; congruence.
Qed.

(** * What the code leaves out of that: a triangle seen exactly edge-on, by a ray that begins in it

    [IntegerBatch._clipped] takes no hit with D = 0, as it has no t. The moved ray can meet such a triangle only where
    the ray begins in its plane (T = 0); it then does at a t infinitely near 0. *)
Theorem edge_on o d a b c h : d <> ZERO -> hit d o a b c = Some h -> denominator_ h = 0%Z ->
  numerator_ h = 0%Z.
Proof.
  intros N. unfold hit, _triangle. set (a' := _sub a o). set (b' := _sub b o). set (c' := _sub c o).
  cbn [map]. set (e1 := _dot d (_cross a' b')). set (e2 := _dot d (_cross b' c')). set (e3 := _dot d (_cross c' a')).
  destruct ((min_ [e1; e2; e3] <? 0) && (0 <? max_ [e1; e2; e3]))%Z eqn:E; [discriminate|].
  intros [= <-]. cbn [numerator_ denominator_]. unfold sum; simpl. intros D.
  assert (Z : e1 = 0%Z /\ e2 = 0%Z /\ e3 = 0%Z).
  { apply andb_false_iff in E. rewrite !Z.ltb_ge in E. simpl in E. lia. }
  destruct Z as (Z1 & Z2 & Z3). set (T := _dot a' (_cross b' c')).
  destruct (Z.eq_dec T 0) as [|NT]; [assumption|]. exfalso. apply N.
  assert (I : forall f : Integers -> Z, f = ix \/ f = iy \/ f = iz ->
    (T * f d = e2 * f a' + e3 * f b' + e1 * f c')%Z).
  { intros f [-> | [-> | ->]]; unfold T, e1, e2, e3, _dot, _cross; cbn [ix iy iz]; ring. }
  assert (X := I ix ltac:(tauto)). assert (Y := I iy ltac:(tauto)). assert (W := I iz ltac:(tauto)).
  rewrite Z1, Z2, Z3 in X, Y, W. destruct d as [x y z]. cbn [ix iy iz] in X, Y, W.
  unfold ZERO. f_equal; apply (Z.mul_reg_l _ _ T NT); lia.
Qed.
(** It matters where the clip range begins behind the ray, and does happen: the cube from -4 to 4, seen
    along +x from (1, 2, -4), a point of its face z = -4. The moved ray enters through that face, at t
    infinitely near 0, and leaves at x = 4, t = 3. The code sees only the second. *)
Definition quad a b c d : list (Integers * Integers * Integers) := [(a, b, c); (a, c, d)].
Definition cube : list (Integers * Integers * Integers) :=
  let p x y z := I3 (4 * x) (4 * y) (4 * z) in
  (quad (p (-1) (-1) (-1)) (p (-1) 1 (-1)) (p 1 1 (-1)) (p 1 (-1) (-1)) ++
   quad (p (-1) (-1) 1) (p 1 (-1) 1) (p 1 1 1) (p (-1) 1 1) ++
   quad (p (-1) (-1) (-1)) (p 1 (-1) (-1)) (p 1 (-1) 1) (p (-1) (-1) 1) ++
   quad (p (-1) 1 (-1)) (p (-1) 1 1) (p 1 1 1) (p 1 1 (-1)) ++
   quad (p (-1) (-1) (-1)) (p (-1) (-1) 1) (p (-1) 1 1) (p (-1) 1 (-1)) ++
   quad (p 1 (-1) (-1)) (p 1 1 (-1)) (p 1 1 1) (p 1 (-1) 1))%Z.
Definition code_sees o d (start : option (Z * Z)) (t : Integers * Integers * Integers) : bool :=
  let '(a, b, c) := t in
  match hit d o a b c with
  | None => false
  | Some h => match _seen start None false h with Some h => is_crossed PERTURBATION h | None => false end
  end.
Example edge_on_counts :
  let o := I3 1 2 (-4) in let d := I3 1 0 0 in let start := Some (-100, 0)%Z in
  length (filter (met_of o d) cube) = 2%nat /\ length (filter (code_sees o d start) cube) = 1%nat.
Proof. vm_compute. split; reflexivity. Qed.
(** Beside the face, by as little as you like, nothing is lost. *)
Example beside_counts :
  let o := I3 1 2 (-3) in let d := I3 1 0 0 in let start := Some (-100, 0)%Z in
  length (filter (met_of o d) cube) = 2%nat /\ length (filter (code_sees o d start) cube) = 2%nat.
Proof. vm_compute. split; reflexivity. Qed.
