(** The theorem of certificates: where the checker says yes to a pixel, the file is right about it.

    The checker's integers are those of Leaf.v. That floats have kept before all that is met up to the
    farthest t that matters is a premise here: Kept.v proves it. *)
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

Definition no_hit : Leaf.Met := Leaf.MakeMet Leaf.NOWHERE 0 0 ZERO [] ZERO.
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
Lemma named_met s : is_met s -> Leaf.named (met_at s) = called s.
Proof.
  unfold is_met, Leaf.exact_hit, Leaf.hit.
  destruct (match shape_of s with Triangular _ => _ | _ => _ end) as [[T n] m].
  destruct (_ =? 0)%Z; [discriminate|]. destruct (Leaf.mixed _); [discriminate|].
  destruct ((_ =? _)%Z && _)%bool; [discriminate|]. now intros [= <-].
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
Notation inside l := (filter (fun s => negb (on_edge a s)) l).
Lemma inside_is l : (forall s, In s l -> is_met s) -> Leaf.inside (map met_at l) = map met_at (inside l).
Proof.
  unfold Leaf.inside. induction l as [|s l IH]; intros H; [reflexivity|]. cbn [map filter].
  rewrite (on_edge_is s) by (apply H; now left). rewrite IH by (intros; apply H; now right).
  now destruct (Leaf.on_edge (met_at s)).
Qed.

(** Fractions are ordered as real numbers are. *)
Definition at_ (s : surface) : R := IZR (Leaf.top (met_at s)) / IZR (Leaf.bottom (met_at s)).
Lemma bottom_not_0 s : is_met s -> Leaf.bottom (met_at s) <> 0%Z.
Proof.
  unfold is_met, Leaf.exact_hit, Leaf.hit.
  destruct (match shape_of s with Triangular _ => _ | _ => _ end) as [[T n] m].
  destruct (Z.eqb_spec (_dot (Leaf.whole p (reals (Leaf.direction p))) n) 0) as [|N]; [discriminate|].
  destruct (Leaf.mixed _); [discriminate|]. destruct ((_ =? _)%Z && _)%bool; [discriminate|].
  now intros [= <-].
Qed.
Lemma gap_at s s' : is_met s -> is_met s' -> gap a s s' = Rcompare (at_ s) (at_ s').
Proof. intros M M'. rewrite gap_is by assumption. apply compare_ratios_right; now apply bottom_not_0. Qed.
Lemma least_is l : (forall s, In s l -> is_met s) ->
  match least_by_gap a l with Some w => In w l /\ forall s, In s l -> at_ w <= at_ s | None => l = [] end.
Proof.
  intros H. unfold least_by_gap. destruct l as [|x l]; [reflexivity|]. cbn [fold_left].
  set (f := fun (best : option surface) s => _).
  assert (E : forall rest best done, (forall s, In s rest -> is_met s) -> is_met best ->
    In best done -> (forall s, In s done -> at_ best <= at_ s) ->
    match fold_left f rest (Some best) with
    | Some w => In w (done ++ rest) /\ forall s, In s (done ++ rest) -> at_ w <= at_ s
    | None => False
    end).
  { induction rest as [|s rest IH]; intros best done R B I L; cbn [fold_left].
    - rewrite app_nil_r. now split.
    - replace (done ++ s :: rest) with ((done ++ [s]) ++ rest) by now rewrite <- app_assoc.
      assert (M : is_met s) by (apply R; now left).
      assert (R' : forall y, In y rest -> is_met y) by (intros; apply R; now right).
      unfold f at 2. rewrite (gap_at s best M B).
      case Rcompare_spec; intros C; apply IH; auto; try (apply in_or_app; simpl; tauto);
        intros y Y; apply in_app_or in Y; destruct Y as [Y|[Y|[]]]; subst; try lra; specialize (L y Y); lra. }
  change (match fold_left f l (Some x) with
    | Some w => In w (x :: l) /\ forall s, In s (x :: l) -> at_ w <= at_ s | None => x :: l = [] end).
  specialize (E l x [x]). destruct (fold_left f l (Some x)) as [w|].
  - apply E; [intros; apply H; now right | apply H; now left | now left |].
    intros y [->|[]]. lra.
  - exfalso. apply E; [intros; apply H; now right | apply H; now left | now left |].
    intros y [->|[]]. lra.
Qed.
Lemma filter_is {A B} (f : A -> B) (P : B -> bool) (Q : A -> bool) l :
  (forall x, In x l -> P (f x) = Q x) -> filter P (map f l) = map f (filter Q l).
Proof.
  induction l as [|x l IH]; intros H; [reflexivity|]. cbn [map filter].
  rewrite (H x) by now left. rewrite IH by (intros; apply H; now right). now destruct (Q x).
Qed.
Lemma front_is l : (forall s, In s l -> is_met s) -> Leaf.front (map met_at l) = map met_at (front a l).
Proof.
  intros H. unfold Leaf.front, front. rewrite inside_is by exact H.
  assert (I : forall s, In s (inside l) -> is_met s) by (intros s S; apply H; now apply filter_In in S).
  assert (K := least_is (inside l) I).
  destruct (least_by_gap a (inside l)) as [w|].
  - destruct K as [W L]. apply filter_is. intros s S. apply eq_iff_eq_true. rewrite forallb_forall.
    rewrite gap_at by auto. split.
    + intros A. specialize (A (met_at w) (in_map met_at _ _ W)). unfold Leaf.not_behind in A.
      rewrite <- gap_is, gap_at in A by auto. now destruct (Rcompare (at_ s) (at_ w)).
    + intros A m M. apply in_map_iff in M. destruct M as (o & <- & O). unfold Leaf.not_behind.
      rewrite <- gap_is, gap_at by auto. specialize (L o O). revert A.
      case Rcompare_spec; case Rcompare_spec; intros; try reflexivity; lra || discriminate.
  - rewrite K. cbn [map forallb]. clear. induction l as [|s l IH]; [reflexivity|]. cbn [map filter].
    now rewrite IH.
Qed.

(** Where there are no ties, what is seen is the first in front; it will be the first of all. *)
Definition seen_of (l : list surface) : option surface :=
  if no_ties a l then match front a l with s :: _ => Some s | [] => None end else first a l.
Theorem sees_is l : (forall s, In s l -> is_met s) ->
  Leaf.sees (map met_at l) = (option_map met_at (seen_of l), negb (no_ties a l)).
Proof.
  intros H. unfold Leaf.sees, seen_of, no_ties. rewrite first_is, front_is, inside_is by exact H.
  set (those := front a l). unfold front in those. revert those.
  assert (I : forall s, In s (inside l) -> In s l /\ on_edge a s = false).
  { intros s S. apply filter_In in S. destruct S as [S E]. split; [exact S|]. now apply negb_true_iff. }
  assert (K : match least_by_gap a (inside l) with Some w => In w (inside l) | None => inside l = [] end).
  { generalize (least_is (inside l) (fun s S => H s (proj1 (I s S)))).
    destruct (least_by_gap a (inside l)); [now intros [L _] | easy]. }
  destruct (least_by_gap a (inside l)) as [w|]; intros those.
  - destruct (I w K) as [W E].
    assert (T : In w those).
    { apply filter_In. split; [exact W|]. now rewrite gap_at, Rcompare_Eq by auto. }
    destruct (inside l) as [|x rest]; [destruct K|].
    destruct those as [|s [|s' those]]; [reflexivity | | reflexivity].
    destruct T as [->|[]]. cbn [map]. now rewrite E.
  - unfold those. clear those. rewrite K.
    destruct l as [|s [|s' l]]; [reflexivity | | reflexivity]. cbn [map].
    assert (E : on_edge a s = true); [|now rewrite E].
    destruct (on_edge a s) eqn:E; [reflexivity|]. exfalso.
    assert (S : In s (inside [s])) by (apply filter_In; rewrite E; split; [now left | reflexivity]).
    rewrite K in S. destruct S.
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
    assert (K : forall l,
      filter (fun s => negb (outside a start end_ s) && less_eq (low a start s) Infinity) l = l).
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

Lemma seen_in l s : seen_of l = Some s -> In s l.
Proof.
  unfold seen_of. destruct (no_ties a l).
  - destruct (front a l) as [|x rest] eqn:F; [discriminate|]. intros [= <-].
    assert (In x (front a l)) as I by (rewrite F; now left). revert I. unfold front.
    destruct (least_by_gap a _); [|easy]. intros I. now apply filter_In in I.
  - unfold first. assert (K : forall l' best, (forall x, best = Some x -> In x l) -> incl l' l ->
      forall x, fold_left (nearer_of a) l' best = Some x -> In x l).
    { induction l' as [|y l' IH]; intros best B I x; [apply B|]. cbn [fold_left]. apply IH.
      - unfold nearer_of. intros z. destruct (is_crossed a y); [|apply B].
        assert (Y : In y l) by (apply I; now left).
        destruct best as [c|]; [|now intros [= <-]].
        destruct (sign_of_difference a y c); [destruct (before y c)| |]; intros [= <-]; auto.
      - intros z Z. apply I. now right. }
    apply K; [discriminate | apply incl_refl].
Qed.
Lemma found_is kept said : Leaf.found p kept = Some said ->
  let hits := filter (hit a) kept in
  said = (match seen_of hits with Some s => called s | None => Leaf.NOWHERE end,
          match seen_of hits with Some s => computed_t a s | None => Infinity end,
          negb (no_ties a hits)).
Proof.
  assert (M : forall s, In s (filter (hit a) kept) -> is_met s).
  { intros s S. apply filter_In in S. now apply met_or_not. }
  unfold Leaf.found. rewrite hits_are, sees_is by exact M. cbv zeta.
  destruct (seen_of (filter (hit a) kept)) as [s|] eqn:F; [|now intros [= <-]]. cbn [option_map].
  assert (S : is_met s) by now apply M, seen_in.
  rewrite (named_met s S). simpl computed_t. unfold asked, t_of. rewrite S.
  destruct (Leaf.division p _ _); [|discriminate]. now intros [= <-].
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

Lemma clear_once scene' o o' : clearly_sees r start end_ scene' o ->
  clearly_sees r start end_ scene' o' -> o = o'.
Proof.
  destruct o as [s|], o' as [s'|]; simpl; try reflexivity.
  - intros (M & _ & A) (M' & _ & A'). destruct (classic (s = s')) as [->|N]; [reflexivity|].
    assert (N' : s' <> s) by congruence. specialize (A s' M' N'). specialize (A' s M N). lra.
  - intros [M _] N. now specialize (N s).
  - intros N [M _]. now specialize (N s').
Qed.
(** The first in front is the one that is seen, if that is clear. *)
Lemma front_is_clear scene' l o : given p scene' -> (forall s, In s l -> met r start end_ scene' s) ->
  (forall s, o = Some s -> In s l) -> no_ties a l = true ->
  clearly_sees r start end_ scene' o -> seen_of l = o.
Proof.
  intros G' M O N C. unfold seen_of. rewrite N.
  assert (I : forall s, In s l -> is_met s).
  { intros s S. destruct (met_hit p G' s (M s S)) as (h & _ & E & _). unfold is_met, met_at. now rewrite E. }
  destruct o as [w|].
  - destruct C as (_ & _ & A). assert (Iw : In w l) by now apply O.
    assert (Q : In w (front a l)).
    { unfold front. assert (K : match least_by_gap a (inside l) with Some v => In v l | None => True end).
      { assert (J : forall s, In s (inside l) -> In s l) by (intros s S; now apply filter_In in S).
        generalize (least_is (inside l) (fun s S => I s (J s S))).
        destruct (least_by_gap a (inside l)); [|easy]. intros [L _]. now apply J. }
      destruct (least_by_gap a _) as [v|]; [|exact Iw]. assert (V : In v l) by exact K.
      apply filter_In. split; [exact Iw|]. simpl. unfold compared.
      destruct (met_hit p G' w (M w Iw)) as (k & _ & -> & Nk & _ & Tk & _).
      destruct (met_hit p G' v (M v V)) as (k' & _ & -> & Nk' & _ & Tk' & _).
      rewrite compare_right by assumption. case Rcompare_spec; try reflexivity. intros L. exfalso.
      destruct (classic (v = w)) as [->|D']; [lra|]. specialize (A v (M v V) D'). lra. }
    unfold no_ties in N. destruct (front a l) as [|x [|y rest]]; [destruct Q | | discriminate].
    destruct Q as [->|[]]. reflexivity.
  - destruct l as [|s l]; [reflexivity|]. destruct (C s). apply M. now left.
Qed.

(** In [plain]'s words, of whatever scene that is all in a list. *)
Lemma by_plain scene' l : given p scene' -> NoDup l -> incl l scene' ->
  (forall s, met r start end_ scene' s -> In s l) ->
  let hits := filter (hit a) l in
  let seen := seen_of hits in
  Nearby.soon (fun by_ => moved_sees r (Nearby.moved_ray r by_) start end_ scene' seen) /\
  (if no_ties a hits then clearly_sees r start end_ scene' seen
   else forall answer, ~ clearly_sees r start end_ scene' answer) /\
  match seen with Some s => computed_t a s = nearest_float (t r s) | None => True end.
Proof.
  intros G' O I A hits.
  assert (C : concat [l] = l) by apply app_nil_r.
  assert (F : ray_facts r start end_ scene' [l] a)
    by (apply (leaf_ray_facts p G'); rewrite C; assumption).
  destruct (Nearby.plain_is_right_by_the_rule r start end_ scene' [l] a F (leaf_rule_facts p G'))
    as (M & K & T).
  destruct (plain_is l) as (E1 & E2 & E3). cbv zeta in M, K, T, E1, E2, E3. fold hits in E1, E3.
  rewrite E1 in M, K, T, E2.
  assert (K' : if no_ties a hits then clearly_sees r start end_ scene' (first a hits)
    else forall answer, ~ clearly_sees r start end_ scene' answer).
  { destruct (no_ties a hits).
    - destruct (certain _); [exact K | exact K |]. destruct E3 as [_ E3]. now specialize (E3 eq_refl).
    - now rewrite (proj1 E3 eq_refl) in K. }
  assert (S : seen_of hits = first a hits).
  { destruct (no_ties a hits) eqn:N; [|unfold seen_of; now rewrite N].
    apply (front_is_clear scene'); auto.
    - intros s S. apply filter_In in S. destruct S as [S H]. now apply (hit_right F s (I s S)).
    - intros s S. assert (Q := K'). rewrite S in Q. destruct Q as [Q _]. apply filter_In.
      split; [now apply A | now apply (hit_right F s (proj1 Q))]. }
  cbv zeta. rewrite S. split; [exact M|]. split; [exact K'|].
  rewrite E2 in T. destruct (first a hits); [now injection T | constructor].
Qed.

(** A surface of the scene, or nothing, by its name in the file: there is one at most. *)
Definition has_name (name : Contest.name) (answer : option surface) : Prop :=
  match answer with Some s => In s scene /\ called s = name | None => name = Leaf.NOWHERE end.
Lemma one_of_a_name name o o' : has_name name o -> has_name name o' -> o' = o.
Proof.
  destruct o as [s|], o' as [s'|]; simpl; try reflexivity.
  - intros [I <-] [I' E]. f_equal. now apply (different_names p _ G).
  - intros [I <-] E. now apply (not_nowhere p _ G) in E.
  - intros -> [I E]. now apply (not_nowhere p _ G) in E.
Qed.
(** What the file says of a pixel is so: the name is that of one surface, or of nothing; the moved ray
    sees it; without ties, the stored ray sees it clearly, and with ties nothing; t is rounded once. *)
Definition is_so (said : Leaf.answer) : Prop :=
  let '(name, t_said, ties) := said in
  exists answer,
    has_name name answer /\ (forall other, has_name name other -> other = answer) /\
    Nearby.soon (fun by_ => moved_sees r (Nearby.moved_ray r by_) start end_ scene answer) /\
    (if ties then forall other, ~ clearly_sees r start end_ scene other
     else clearly_sees r start end_ scene answer) /\
    t_said = match answer with Some s => nearest_float (T r s / D r s) | None => Infinity end.
Theorem yes_is_right said :
  (* of all that the stored ray meets in the clip range, floats have kept what is not beyond [far] *)
  (forall s, met r start end_ scene s -> not_beyond (t r s) (far said) -> In s kept) ->
  (* yes: the file's name, t and whether there are ties are those that are found *)
  Leaf.found p kept = Some said -> is_so said.
Proof.
  unfold is_so. destruct said as [[name t_said] ties]. intros Kept Found. apply found_is in Found. revert Found. cbv zeta.
  set (seen := seen_of (filter (hit a) kept)).
  remember (no_ties a (filter (hit a) kept)) as clear eqn:NT.
  intros Found. symmetry in Found. injection Found as Name T_ Ties.
  exists seen.
  assert (H : has_name name seen).
  { unfold has_name. rewrite <- Name. destruct seen as [s|] eqn:Seen; [|reflexivity]. split; [|reflexivity].
    apply kept_some. assert (J : In s (filter (hit a) kept)) by now apply seen_in.
    now apply filter_In in J. }
  split; [exact H|]. split; [intros o; now apply one_of_a_name|]. clear H Name.
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
  change (seen_of (filter (hit a) kept)) with seen in C, Q. rewrite Seen in C, Q.
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
  rewrite (clear_once _ _ _ K Clear) in M'.
  split; [exact M'|]. split; [exact Clear|]. rewrite <- T_. exact Q.
Qed.
End Yes.
End Pixel.
