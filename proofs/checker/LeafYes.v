(** The theorem of certificates: where the checker says yes to a pixel, the file is right about it.

    The checker's integers are those of Leaf.v. Which surfaces floats have dropped before is a premise:
    that what is met up to the farthest t that matters is kept, is argued by hand, at the head of
    verify.py. *)
Require Import ZArith Reals Psatz List Bool Classical.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Integers Clip.
From Reftrace Require Import Contest Facts.
From Reftrace Require Ties Hits Nearest Settle Nearby.
From Reftrace Require Import CodeAnswers.
From Reftrace Require Leaf.
From Reftrace Require Import LeafHits LeafRight.
Import ListNotations.
Open Scope R_scope.

Section Pixel.
Variable p : Leaf.pixel.
Notation r := (Leaf.stored_ray p).
Notation start := (Leaf.start p).
Notation end_ := (Leaf.end_ p).
Notation a := (by_leaf p).

(** ** [sees] of hits is what a contest of surfaces makes of them *)

Definition no_hit : Leaf.Met := Leaf.MakeMet Leaf.NOWHERE 0 0 ZERO [] [] 0 ZERO.
Definition met_at (s : surface) : Leaf.Met :=
  match Leaf.exact_hit p s with Some h => h | None => no_hit end.
Definition is_met (s : surface) : Prop := Leaf.exact_hit p s = Some (met_at s).
Lemma met_or_not s : hit a s = true <-> is_met s.
Proof.
  unfold is_met, met_at. simpl. unfold asked. destruct (Leaf.exact_hit p s); split; congruence.
Qed.
Lemma hits_are kept : Leaf.hits p kept = map met_at (filter (hit a) kept).
Proof.
  unfold Leaf.hits. induction kept as [|s kept IH]; [reflexivity|]. cbn [flat_map filter].
  destruct (hit a s) eqn:H.
  - apply met_or_not in H. rewrite H. cbn [map app]. now rewrite <- IH.
  - simpl in H. unfold asked in H. destruct (Leaf.exact_hit p s); [discriminate|]. exact IH.
Qed.
Lemma met_line s : is_met s -> exists h, line_hit (as_inputs p) (Leaf.together p) s = Some h /\
  denominator_ h <> 0%Z /\ met_at s = met_of (called s) h.
Proof.
  unfold is_met. rewrite exact_hit_line. destruct (line_hit _ _ s) as [h|]; [|discriminate].
  destruct (Z.eqb_spec (denominator_ h) 0) as [|N]; [discriminate|]. cbv zeta.
  destruct (Leaf.clipped _ _ _ _); [discriminate|]. intros [= E]. eauto.
Qed.
Lemma named_met s : is_met s -> Leaf.named (met_at s) = called s.
Proof.
  intros M. destruct (met_line s M) as (h & _ & _ & ->).
  now destruct (met_of_turned (called s) h) as (_ & _ & _ & -> & _).
Qed.

Lemma on_edge_is s : is_met s -> on_edge a s = Leaf.on_edge (met_at s).
Proof. intros M. simpl. unfold asked. now rewrite M. Qed.
Lemma gap_is s s' : is_met s -> is_met s' -> gap a s s' = Leaf.compare_at (met_at s) (met_at s').
Proof. intros M M'. simpl. unfold compared. now rewrite M, M'. Qed.
Lemma is_crossed_is s : is_met s -> is_crossed a s = Leaf.is_crossed Leaf.AXES (met_at s).
Proof. intros M. simpl. unfold asked. now rewrite M. Qed.
Lemma nearer_is best s : is_met s -> (forall b, best = Some b -> is_met b) ->
  Leaf.nearer_of Leaf.AXES (option_map met_at best) (met_at s) = option_map met_at (nearer_of a best s) /\
  (forall b, nearer_of a best s = Some b -> is_met b).
Proof.
  intros M B. unfold Leaf.nearer_of, nearer_of. rewrite (is_crossed_is s M).
  destruct (Leaf.is_crossed Leaf.AXES (met_at s)); [|split; [reflexivity | exact B]].
  destruct best as [c|]; [|split; [reflexivity | intros x [= <-]; exact M]].
  specialize (B c eq_refl). cbn [option_map]. unfold Leaf.is_before.
  rewrite !named_met by assumption. unfold sign_of_difference, by_leaf, compared. rewrite M, B.
  fold (before s c).
  destruct (Z.compare_spec (Leaf.order Leaf.AXES (met_at s) (met_at c)) 0) as [Z|Z|Z].
  - rewrite Z. cbn [Z.ltb Z.compare Z.eqb orb andb]. destruct (before s c); split; try reflexivity;
      intros x [= <-]; assumption.
  - apply Z.ltb_lt in Z. rewrite Z. split; [reflexivity|]. intros x [= <-]. exact M.
  - replace (_ <? 0)%Z with false by (symmetry; apply Z.ltb_ge; lia).
    replace (_ =? 0)%Z with false by (symmetry; apply Z.eqb_neq; lia).
    split; [reflexivity|]. intros x [= <-]. exact B.
Qed.
Lemma first_is l : (forall s, In s l -> is_met s) ->
  Leaf.first Leaf.AXES (map met_at l) = option_map met_at (first a l).
Proof.
  unfold Leaf.first, first. intros H.
  assert (E : forall best, (forall b, best = Some b -> is_met b) ->
    fold_left (Leaf.nearer_of Leaf.AXES) (map met_at l) (option_map met_at best) =
    option_map met_at (fold_left (nearer_of a) l best)).
  { induction l as [|s l IH]; intros best B; [reflexivity|]. cbn [map fold_left].
    destruct (nearer_is best s (H s (or_introl eq_refl)) B) as [E B'].
    rewrite E. apply IH; auto. intros x X. apply H. now right. }
  apply (E None). discriminate.
Qed.
Lemma inside_is l : (forall s, In s l -> is_met s) ->
  filter (fun h => negb (Leaf.on_edge h)) (map met_at l) = map met_at (filter (fun s => negb (on_edge a s)) l).
Proof.
  induction l as [|s l IH]; intros H; [reflexivity|]. cbn [map filter].
  rewrite (on_edge_is s) by (apply H; now left). rewrite IH by (intros; apply H; now right).
  now destruct (Leaf.on_edge (met_at s)).
Qed.
Lemma least_is l : (forall s, In s l -> is_met s) ->
  Leaf.least_at (map met_at l) = option_map met_at (least_by_gap a l) /\
  match least_by_gap a l with Some s => In s l | None => l = [] end.
Proof.
  unfold Leaf.least_at, least_by_gap. intros H.
  set (f := fun (best : option Leaf.Met) h => _). set (g := fun (best : option surface) s => _).
  assert (E : forall rest best, (forall s, In s rest -> is_met s) -> is_met best ->
    fold_left f (map met_at rest) (Some (met_at best)) = option_map met_at (fold_left g rest (Some best)) /\
    match fold_left g rest (Some best) with Some s => In s (best :: rest) | None => False end).
  { induction rest as [|s rest IH]; intros best R B; [simpl; auto|]. cbn [map fold_left].
    assert (M : is_met s) by (apply R; now left).
    assert (R' : forall x, In x rest -> is_met x) by (intros; apply R; now right).
    unfold f at 2, g at 2 4. cbv beta. rewrite (gap_is s best M B).
    destruct (Leaf.compare_at (met_at s) (met_at best)).
    - destruct (IH best R' B) as [-> K]. split; [reflexivity|].
      destruct (fold_left g rest (Some best)); [simpl in *; tauto | exact K].
    - destruct (IH s R' M) as [-> K]. split; [reflexivity|].
      destruct (fold_left g rest (Some s)); [simpl in *; tauto | exact K].
    - destruct (IH best R' B) as [-> K]. split; [reflexivity|].
      destruct (fold_left g rest (Some best)); [simpl in *; tauto | exact K]. }
  destruct l as [|x l]; [split; reflexivity|]. cbn [map fold_left].
  destruct (E l x) as [E1 E2]; [intros; apply H; now right | apply H; now left |].
  split; [exact E1|].
  change (match fold_left g l (Some x) with Some s => In s (x :: l) | None => x :: l = [] end).
  destruct (fold_left g l (Some x)); [exact E2 | destruct E2].
Qed.
Lemma filter_is {A B} (f : A -> B) (P : B -> bool) (Q : A -> bool) l :
  (forall x, In x l -> P (f x) = Q x) -> filter P (map f l) = map f (filter Q l).
Proof.
  induction l as [|x l IH]; intros H; [reflexivity|]. cbn [map filter].
  rewrite (H x) by now left. rewrite IH by (intros; apply H; now right). now destruct (Q x).
Qed.
Lemma front_is l : (forall s, In s l -> is_met s) ->
  Leaf.front (map met_at l) = map met_at (front a l).
Proof.
  intros H. unfold Leaf.front, front. rewrite inside_is by exact H.
  set (inside := filter _ l).
  assert (I : forall s, In s inside -> is_met s) by (intros s S; apply H; now apply filter_In in S).
  destruct (least_is inside I) as [-> K]. destruct (least_by_gap a inside) as [w|]; [|reflexivity].
  cbn [option_map]. apply filter_is. intros s S. now rewrite gap_is by auto.
Qed.

Theorem sees_is l : (forall s, In s l -> is_met s) ->
  Leaf.sees (map met_at l) = (option_map met_at (first a l), negb (no_ties a l)).
Proof.
  intros H.
  assert (Among : Leaf.sees_among (map met_at l) = (option_map met_at (first a l), negb (no_ties a l))).
  { unfold Leaf.sees_among. rewrite first_is, front_is, inside_is by exact H. apply f_equal.
    unfold no_ties, front. set (inside := filter (fun s => negb (on_edge a s)) l).
    assert (I : forall s, In s inside -> In s l /\ on_edge a s = false).
    { intros s S. apply filter_In in S. destruct S as [S E]. split; [exact S|]. now apply negb_true_iff. }
    destruct (least_is inside) as [_ K]; [intros s S; apply H; now apply I|].
    destruct (least_by_gap a inside) as [w|].
    - destruct (I w K) as [W E]. set (those := filter _ l).
      assert (In w those) as T.
      { apply filter_In. split; [exact W|]. rewrite gap_is by auto. unfold Leaf.compare_at.
        now rewrite Z.compare_refl. }
      destruct inside as [|x inside]; [destruct K|].
      destruct those as [|s [|s' those]]; [reflexivity | | reflexivity].
      destruct T as [->|[]]. cbn [map]. now rewrite E.
    - rewrite K. destruct l as [|s [|s' l]]; [reflexivity | | reflexivity]. cbn [map].
      assert (E : on_edge a s = true); [|now rewrite E].
      destruct (on_edge a s) eqn:E; [reflexivity|]. exfalso.
      assert (In s inside) as S by (apply filter_In; rewrite E; split; [now left | reflexivity]).
      rewrite K in S. destruct S. }
  destruct l as [|s [|s' l]]; [exact Among | | exact Among]. cbn [map] in *. unfold Leaf.sees.
  assert (M : is_met s) by (apply H; now left). rewrite <- (on_edge_is s M).
  destruct (on_edge a s) eqn:E; [exact Among|].
  unfold no_ties, front. cbn [filter]. rewrite E. cbn [negb least_by_gap fold_left filter].
  rewrite gap_is by exact M. unfold Leaf.compare_at at 1. rewrite Z.compare_refl, E.
  unfold first. cbn [fold_left]. unfold nearer_of. rewrite is_crossed_is by exact M.
  replace (Leaf.is_crossed Leaf.AXES (met_at s)) with true; [reflexivity|]. symmetry.
  destruct (met_line s M) as (h & L & N & Q). rewrite (on_edge_is s M) in E. rewrite Q, on_edge_met in E.
  rewrite Q, is_crossed_right; [| eapply line_is_hit, L | exact N]. unfold Hits.is_crossed. now rewrite E.
Qed.

(** And that is what [plain] makes of them, if all is left to integers. *)
Lemma plain_is kept : let result := plain a start end_ [kept] in
  owner result = first a (filter (hit a) kept) /\
  t_of_owner result = option_map (computed_t a) (owner result) /\
  (no_ties a (filter (hit a) kept) = false <-> certain result = AMBIGUOUS).
Proof.
  assert (E : found a start (fold_left (enter a start end_) [kept] nothing_yet) = kept).
  { cbn [fold_left]. unfold enter, nothing_yet. cbn [farthest Contest.kept].
    assert (F : forall l : list surface, filter (possible a) l = l).
    { induction l as [|s l IH]; [reflexivity|]. exact (f_equal (cons s) IH). }
    rewrite F. assert (N : nearest_sure a start end_ Infinity kept = Infinity).
    { unfold nearest_sure. induction kept as [|s l IH]; [reflexivity|]. exact IH. }
    rewrite N. assert (Low : forall s, low a start s = MinusInfinity).
    { intros s. unfold low, high. cbn [interval_low interval_high by_leaf is_finite].
      now destruct (behind start). }
    assert (K : forall l, filter (fun s => negb (outside a start end_ s) && less_eq (low a start s) Infinity) l = l).
    { induction l as [|s l IH]; [reflexivity|]. cbn [filter]. rewrite IH, Low. unfold outside, high.
      cbn [interval_low interval_high by_leaf less]. destruct end_; reflexivity. }
    rewrite K. unfold found. cbn [farthest Contest.kept app].
    induction kept as [|s l IH]; [reflexivity|]. cbn [filter]. rewrite Low, IH; auto. }
  unfold plain, hits. rewrite E. destruct kept as [|s [|s' l]].
  - cbn. repeat split; discriminate.
  - assert (S : SURE a start end_ s = false) by reflexivity. rewrite S.
    unfold by_integers, entry. cbn [owner certain t_of_owner].
    repeat split; destruct (no_ties _ _); congruence.
  - cbn [order_applies by_leaf andb]. unfold by_integers, entry. cbn [owner certain t_of_owner].
    repeat split; destruct (no_ties _ _); congruence.
Qed.

(** ** Up to where all that is met must have been kept *)

(** [np.nextafter(x, np.inf)] *)
Definition after (x : number) : number :=
  match x with
  | Finite x => Finite (succ radix2 fexp x)
  | MinusInfinity => Finite (- pred radix2 fexp (bpow radix2 emax))
  | Infinity => Infinity
  end.
(** [far] of verify.py: where the file says that there are ties, the end of the clip range; else what is
    just above its t, if that is in the range. *)
Definition far (said : Leaf.answer) : number :=
  let '(_, t, ties) := said in if ties then end_ else after (least t end_).
Definition not_beyond (x : R) (far : number) : Prop :=
  match far with Finite f => x <= f | Infinity => True | MinusInfinity => False end.

Lemma below_after x : not_beyond x (after (nearest_float x)).
Proof.
  unfold nearest_float. case Rlt_bool_spec; intros H.
  - cbn. apply succ_round_ge_id; [apply fexp_valid|]. apply valid_rnd_N.
  - case Rlt_bool_spec; intros N; [|exact I]. cbn.
    destruct (Rle_or_lt x (- pred radix2 fexp (bpow radix2 emax))) as [|L]; [assumption | exfalso].
    assert (F : generic_format radix2 fexp (- pred radix2 fexp (bpow radix2 emax))).
    { apply generic_format_opp, generic_format_pred; [apply fexp_valid|].
      apply generic_format_bpow. now vm_compute. }
    assert (G : - pred radix2 fexp (bpow radix2 emax) <= rnd x).
    { apply round_ge_generic; [apply fexp_valid | apply valid_rnd_N | exact F | lra]. }
    assert (P : pred radix2 fexp (bpow radix2 emax) < bpow radix2 emax).
    { apply pred_lt_id, Rgt_not_eq, bpow_gt_0. }
    assert (Z : rnd x <= 0).
    { apply round_le_generic;
        [apply fexp_valid | apply valid_rnd_N | apply generic_format_0 | lra]. }
    rewrite Rabs_left1 in H by exact Z. lra.
Qed.
Lemma below_least x y : not_beyond x (after y) ->
  match end_ with Finite e => x <= e | Infinity => True | MinusInfinity => False end ->
  not_beyond x (after (least y end_)).
Proof.
  unfold least. intros H K. destruct (less end_ y); [|exact H].
  destruct end_ as [|e|]; cbn in *; auto; [easy|]. apply Rle_trans with e; [exact K|]. apply succ_ge_id.
Qed.

(** ** The theorem *)

Lemma found_is kept : Leaf.found p kept =
  let hits := filter (hit a) kept in
  (match first a hits with Some s => called s | None => Leaf.NOWHERE end,
   match first a hits with Some s => computed_t a s | None => Infinity end,
   negb (no_ties a hits)).
Proof.
  assert (M : forall s, In s (filter (hit a) kept) -> is_met s).
  { intros s S. apply filter_In in S. now apply met_or_not. }
  unfold Leaf.found. rewrite hits_are, sees_is by exact M. cbv zeta.
  destruct (first a (filter (hit a) kept)) as [s|] eqn:F; [|reflexivity]. cbn [option_map].
  assert (S : is_met s).
  { revert F. unfold first.
    assert (K : forall l best, (forall x, In x l -> is_met x) -> (forall x, best = Some x -> is_met x) ->
      forall x, fold_left (nearer_of a) l best = Some x -> is_met x).
    { induction l as [|y l IH]; intros best L B x; [apply B|]. cbn [fold_left]. apply IH.
      - intros z Z. apply L. now right.
      - apply nearer_is; [apply L; now left | exact B]. }
    apply K; [exact M | discriminate]. }
  rewrite (named_met s S). simpl computed_t. unfold asked. now rewrite S.
Qed.

Section Yes.
Context {scene kept : list surface}.
Hypothesis G : given p scene.
Hypothesis scene_once : NoDup scene.
Hypothesis kept_once : NoDup kept.
Hypothesis kept_some : incl kept scene.

Lemma given_kept : given p kept.
Proof.
  destruct G. constructor; auto.
Qed.

(** In [plain]'s words, of whatever scene that is all in a list. *)
Lemma by_plain scene' l : given p scene' -> NoDup l -> incl l scene' ->
  (forall s, met r start end_ scene' s -> In s l) ->
  let seen := first a (filter (hit a) l) in
  Nearby.soon (fun by_ => moved_sees r (Nearby.moved_ray r by_) start end_ scene' seen) /\
  (if no_ties a (filter (hit a) l) then clearly_sees r start end_ scene' seen
   else forall answer, ~ clearly_sees r start end_ scene' answer) /\
  match seen with Some s => computed_t a s = nearest_float (t r s) | None => True end.
Proof.
  intros G' O I A seen.
  assert (C : concat [l] = l) by apply app_nil_r.
  assert (F : ray_facts r start end_ scene' [l] a)
    by (apply (leaf_ray_facts p G'); rewrite C; assumption).
  destruct (Nearby.plain_is_right_by_the_rule r start end_ scene' [l] a F (leaf_rule_facts p G'))
    as (M & K & T).
  destruct (plain_is l) as (E1 & E2 & E3). cbv zeta in M, K, T, E1, E2, E3.
  rewrite E1 in M, K, T, E2. fold seen in M, K, T, E2. split; [exact M|]. split.
  - destruct (no_ties a (filter (hit a) l)).
    + destruct (certain _); [exact K | exact K |]. destruct E3 as [_ E3]. now specialize (E3 eq_refl).
    + now rewrite (proj1 E3 eq_refl) in K.
  - rewrite E2 in T. destruct seen; [now injection T | constructor].
Qed.

Lemma clear_once o o' : clearly_sees r start end_ scene o -> clearly_sees r start end_ scene o' -> o = o'.
Proof.
  destruct o as [s|], o' as [s'|]; simpl; try reflexivity.
  - intros (M & _ & A) (M' & _ & A'). destruct (classic (s = s')) as [->|N]; [reflexivity|].
    assert (N' : s' <> s) by congruence. specialize (A s' M' N'). specialize (A' s M N). lra.
  - intros [M _] N. now specialize (N s).
  - intros N [M _]. now specialize (N s').
Qed.

Theorem yes_is_right said :
  (* of all that the stored ray meets in the clip range, floats have kept what is not beyond [far] *)
  (forall s, met r start end_ scene s -> not_beyond (t r s) (far said) -> In s kept) ->
  (* yes: the file's name, t and whether there are ties are those that are found *)
  Leaf.found p kept = said ->
  let '(name, t_said, ties) := said in
  exists answer,
    name = match answer with Some s => called s | None => Leaf.NOWHERE end /\
    Nearby.soon (fun by_ => moved_sees r (Nearby.moved_ray r by_) start end_ scene answer) /\
    (if ties then forall other, ~ clearly_sees r start end_ scene other
     else clearly_sees r start end_ scene answer) /\
    t_said = match answer with Some s => nearest_float (T r s / D r s) | None => Infinity end.
Proof.
  destruct said as [[name t_said] ties]. intros Kept. rewrite found_is. cbv zeta.
  set (seen := first a (filter (hit a) kept)).
  remember (no_ties a (filter (hit a) kept)) as clear eqn:NT. intros [= Name T_ Ties].
  exists seen. split; [now rewrite <- Name|].
  assert (All : (forall s, met r start end_ scene s -> In s kept) ->
    Nearby.soon (fun by_ => moved_sees r (Nearby.moved_ray r by_) start end_ scene seen) /\
    (if ties then forall other, ~ clearly_sees r start end_ scene other
     else clearly_sees r start end_ scene seen) /\
    t_said = match seen with Some s => nearest_float (T r s / D r s) | None => Infinity end).
  { intros A. destruct (by_plain scene kept G kept_once kept_some A) as (M & K & Q).
    fold seen in M, K, Q. rewrite <- NT in K. split; [exact M|]. split.
    - rewrite <- Ties. destruct clear; exact K.
    - rewrite <- T_. destruct seen as [s|]; [exact Q | reflexivity]. }
  unfold far in Kept. destruct ties.
  { apply All. intros s M. apply Kept; [exact M|]. destruct M as (_ & _ & _ & E & _). exact E. }
  destruct seen as [s|] eqn:Seen.
  2: { apply All. intros s M. apply Kept; [exact M|]. rewrite <- T_. apply below_least; [exact I|].
    destruct M as (_ & _ & _ & E & _). exact E. }
  (* clear: what has been dropped is farther *)
  clear All. change (computed_t a s = t_said) in T_.
  destruct (by_plain kept kept given_kept kept_once (incl_refl _)) as (_ & C & Q); [now intros x [X _]|].
  change (first a (filter (hit a) kept)) with seen in C, Q. rewrite Seen in C, Q.
  rewrite <- NT in C. destruct clear; [|discriminate Ties].
  destruct C as (M & W & A).
  assert (Ms : met r start end_ scene s) by (destruct M as (X & Y); split; [now apply kept_some | exact Y]).
  assert (Near : not_beyond (t r s) (after (least t_said end_))).
  { apply below_least; [|apply Ms]. rewrite <- T_, Q. apply below_after. }
  assert (Clear : clearly_sees r start end_ scene (Some s)).
  { split; [exact Ms|]. split; [exact W|]. intros s' M' N.
    destruct (classic (not_beyond (t r s') (after (least t_said end_)))) as [B|B].
    - apply A; [|exact N]. split; [now apply Kept | apply M'].
    - destruct (after (least t_said end_)) as [|f|]; simpl in B, Near; [easy | lra | now destruct B]. }
  destruct (by_plain scene scene G scene_once (incl_refl _)) as (M' & K & _); [now intros x [X _]|].
  destruct (no_ties a (filter (hit a) scene)); [|now apply K in Clear].
  rewrite (clear_once _ _ K Clear) in M'.
  split; [exact M'|]. split; [exact Clear|]. rewrite <- T_. exact Q.
Qed.
End Yes.
End Pixel.
