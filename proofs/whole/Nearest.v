(** Who is left at the end of a contest: of all that is met, the nearest are. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Contest Facts.
Import ListNotations.
Open Scope R_scope.

Section Nearest.
Context {r moved : ray} {start : R} {end_ : number} {scene : list surface}.
Context {batches : list (list surface)} {a : answers}.
Hypothesis F : facts r moved start end_ scene batches a.

Local Notation met := (met r start end_ scene).
Local Notation clearly_sees := (clearly_sees r start end_ scene).
Local Notation moved_meets := (moved_meets r moved start end_ scene).
Local Notation moved_sees := (moved_sees r moved start end_ scene).
Local Notation high := (high a).
Local Notation low := (low a start).
Local Notation SURE := (SURE a start end_).
Local Notation enter := (enter a start end_).
Local Notation those := (found a start (fold_left enter batches nothing_yet)).

(** ** Names *)

Lemma before_spec s s' : before s s' = true <->
  (fst (called s) < fst (called s') \/
   fst (called s) = fst (called s') /\ snd (called s) < snd (called s'))%Z.
Proof.
  unfold before, name_before.
  rewrite orb_true_iff, andb_true_iff, !Z.ltb_lt, Z.eqb_eq. tauto.
Qed.
Lemma before_trans s s' s'' : before s s' = true -> before s' s'' = true -> before s s'' = true.
Proof. rewrite !before_spec. lia. Qed.
Lemma before_differs s s' : before s s' = true -> s <> s'.
Proof. intros H E. subst. rewrite before_spec in H. lia. Qed.
Lemma not_both_before s s' : before s s' = true -> before s' s = true -> False.
Proof. rewrite !before_spec. lia. Qed.
Lemma before_total s s' : In s scene -> In s' scene -> s <> s' ->
  before s s' = true \/ before s' s = true.
Proof.
  intros H H' N. rewrite !before_spec.
  destruct (called s) as [i k] eqn:E, (called s') as [i' k'] eqn:E'. simpl.
  destruct (Z.eq_dec i i'); [destruct (Z.eq_dec k k'); [|lia] | lia].
  exfalso. apply N. apply (names_differ F); congruence.
Qed.
Lemma same_or_not s s' : In s scene -> In s' scene -> s = s' \/ s <> s'.
Proof.
  intros H H'. destruct (before s s') eqn:B; [right; now apply before_differs|].
  destruct (before s' s) eqn:B'; [right; intro; subst; now apply before_differs in B'|].
  left. apply (names_differ F); auto.
  destruct (called s) as [i k] eqn:E, (called s') as [i' k'] eqn:E'.
  assert (N : forall x y, before x y = false -> ~ (before x y = true)) by congruence.
  apply N in B. apply N in B'. rewrite before_spec in B, B'. rewrite E, E' in *. simpl in *.
  f_equal; lia.
Qed.

(** ** Planes *)

Lemma same_plane_sym s s' : same_plane s s' -> same_plane s' s.
Proof.
  intros [k [K H]]. exists (/ k). split; [now apply Rinv_neq_0_compat|].
  intros q. destruct (H q) as [A B]. rewrite A, B. split; now field.
Qed.
Lemma same_plane_trans s s' s'' : same_plane s s' -> same_plane s' s'' -> same_plane s s''.
Proof.
  intros [k [K H]] [l [L I]]. exists (k * l). split; [now apply Rmult_integral_contrapositive|].
  intros q. destruct (H q) as [A B], (I q) as [A' B']. rewrite A, B, A', B'. split; ring.
Qed.
Lemma same_plane_t q s s' : same_plane s s' -> D q s' <> 0 -> t q s = t q s'.
Proof. intros [k [K H]] N. destruct (H q) as [A B]. unfold t. rewrite A, B. now field. Qed.

Lemma within_D q s : meets_within q s -> D q s <> 0.
Proof.
  unfold meets_within, D. destruct (shape_of s) as [x|]; auto.
  unfold meets_inside. rewrite denominator_sum. lra.
Qed.
Lemma closed_D q s : meets_closed q s -> D q s <> 0.
Proof. unfold meets_closed, D. destruct (shape_of s) as [x|]; auto. intros [H _]. exact H. Qed.
Lemma within_closed q s : meets_within q s -> meets_closed q s.
Proof.
  intros H. assert (N := within_D _ _ H). revert H N.
  unfold meets_within, meets_closed, D. destruct (shape_of s) as [x|]; auto.
  unfold meets_inside, meets. intros. split; auto. lra.
Qed.
Lemma met_D s : met s -> D r s <> 0.
Proof. intros [_ [H _]]. now apply closed_D. Qed.
Lemma met_in s : met s -> In s scene.
Proof. now intros []. Qed.
Lemma moved_meets_met s : moved_meets s -> met s.
Proof.
  intros [A [B [C E]]]. repeat split; try apply E; auto. now apply (moved_meets_no_more F).
Qed.

(** ** What a float comparison says *)

Lemma less_spec x y : less (Finite x) (Finite y) = true <-> x < y.
Proof. simpl. case Rlt_bool_spec; intros; split; intros; auto; try discriminate; lra. Qed.

Lemma start_le s : met s -> start <= t r s.
Proof. now intros [_ [_ []]]. Qed.

(** What is sure is met. *)
Lemma sure_is_met s : In s scene -> SURE s = true ->
  met s /\ meets_within r s /\ start < t r s /\
  exists h, high s = Finite h /\ t r s <= h /\ float64 h /\ at_most (low s) (t r s).
Proof.
  intros I H. unfold Contest.SURE, in_range in H. rewrite !andb_true_iff in H.
  destruct H as [[H1 H2] [H3 H4]]. unfold high, Contest.high in *.
  destruct (interval_high a s) as [|h|] eqn:E; try discriminate.
  destruct (interval_above F _ _ I E) as [Fh [N Th]].
  assert (L : at_most (interval_low a s) (t r s)).
  { apply (interval_below F); auto. right. now rewrite E. }
  assert (W : meets_within r s).
  { generalize (surely F _ I H1). unfold meets_within. destruct (shape_of s); auto. }
  assert (S : start < t r s).
  { destruct (interval_low a s) as [|l|]; simpl in L; try discriminate.
    - apply less_spec in H3. lra.
    - specialize (L _ Fh). lra. }
  repeat split; auto; try lra.
  - now apply within_closed.
  - destruct end_ as [|e|]; try discriminate; auto. apply less_spec in H4. lra.
  - exists h. repeat split; auto. unfold low, Contest.low, Contest.high. rewrite E. simpl.
    destruct (behind start); auto.
Qed.

(** What is met is possible, not outside, and not nearer than its [low]. *)
Lemma met_low s : met s -> at_most (low s) (t r s).
Proof.
  intros M. assert (S := start_le _ M). assert (N := met_D _ M). assert (I := met_in _ M).
  unfold low, Contest.low, Contest.high, behind. case Rlt_bool_spec; intros B.
  - destruct (is_finite (interval_high a s)) eqn:E; simpl; auto. apply (interval_below F); auto.
  - apply (interval_below F); auto. left. lra.
Qed.
Lemma met_possible s : met s -> possible a s = true.
Proof.
  intros [I [H _]]. destruct (possible a s) eqn:E; auto. now destruct (impossible F _ I E).
Qed.
Lemma met_not_outside s : met s -> outside a start end_ s = false.
Proof.
  intros M. assert (S := start_le _ M). assert (N := met_D _ M). assert (I := met_in _ M).
  destruct (outside a start end_ s) eqn:O; auto. exfalso.
  unfold outside in O. apply andb_prop in O. destruct O as [O B].
  assert (L : at_most (interval_low a s) (t r s)).
  { apply (interval_below F); auto. unfold behind, Contest.high in B. revert B.
    case Rlt_bool_spec; intros B; [intros; now right | left; lra]. }
  unfold Contest.high in *. apply orb_prop in O. destruct O as [O|O].
  - destruct (interval_high a s) as [|h|] eqn:E; try discriminate.
    + (* an upper end is never -inf *) clear B. destruct M as [_ [_ [_ [_ _]]]]. simpl in O.
      exfalso. revert E. apply (interval_not_minus F). exact I.
    + destruct (interval_above F _ _ I E) as [_ [_ Th]]. apply less_spec in O. lra.
  - generalize (end_is_float F). destruct M as [_ [_ [_ [C _]]]].
    destruct end_ as [|e|]; try discriminate; try contradiction; intros Fe.
    destruct (interval_low a s) as [|l|]; try discriminate; simpl in L.
    + apply less_spec in O. lra.
    + specialize (L _ Fe). lra.
Qed.

(** ** The contest: whoever is not kept is surely behind someone who is *)

(** [low] above a [high] that is a float: then t is, too. *)
Lemma low_above h s : met s -> float64 h -> less (Finite h) (low s) = true -> h < t r s.
Proof.
  intros M Fh L. assert (A := met_low _ M). destruct (low s) as [|l|]; try discriminate; simpl in A.
  - apply less_spec in L. lra.
  - now apply A.
Qed.
Lemma less_weaken f g x : less g f = true -> less f x = true -> less g x = true.
Proof.
  destruct f as [|f|], g as [|g|], x as [|x|]; simpl; auto; try discriminate.
  intros A B. change (less (Finite g) (Finite f) = true) in A.
  change (less (Finite f) (Finite x) = true) in B. change (less (Finite g) (Finite x) = true).
  rewrite less_spec in *. lra.
Qed.
Lemma less_irrefl x : less x x = false.
Proof. destruct x; simpl; auto. case Rlt_bool_spec; auto. intros; lra. Qed.

(** The nearest of what is sure, and that it does not grow. *)
Lemma nearest_sure_is pairs f :
  let g := nearest_sure a start end_ f pairs in
  (g = f \/ exists w, In w pairs /\ SURE w = true /\ high w = g) /\
  (forall x, less f x = true -> less g x = true).
Proof.
  revert f. induction pairs as [|s pairs IH]; intros f g; simpl in g.
  - unfold g. split; auto.
  - destruct (SURE s) eqn:S.
    + destruct (IH (least f (high s))) as [A B]. fold g in A, B.
      assert (C : least f (high s) = f \/ least f (high s) = high s /\ less (high s) f = true).
      { unfold least. destruct (less (high s) f); auto. }
      split.
      * destruct A as [A|[w [I W]]]; [|right; exists w; simpl; tauto].
        destruct C as [C|[C _]]; [left; congruence|].
        right. exists s. repeat split; simpl; auto. congruence.
      * intros x X. apply B. destruct C as [C|[C L]]; rewrite C; auto. now apply (less_weaken f).
    + destruct (IH f) as [A B]. fold g in A, B. split; auto.
      destruct A as [A|[w [I W]]]; auto. right. exists w. simpl. tauto.
Qed.

Record kept_well (seen : list surface) (c : contest) : Prop := {
  kept_nearest : farthest c = Infinity \/
    exists w, In w (kept c) /\ SURE w = true /\ high w = farthest c;
  kept_all : forall s, In s seen -> met s -> In s (kept c) \/ less (farthest c) (low s) = true;
  kept_some : incl (kept c) seen;
  kept_once : NoDup (kept c)
}.

Lemma NoDup_join (k l : list surface) p : NoDup k -> NoDup l -> (forall x, In x k -> ~ In x l) ->
  NoDup (k ++ filter p l).
Proof.
  intros K L H. induction k as [|x k IH]; simpl; [now apply NoDup_filter|].
  inversion K; subst. constructor.
  - rewrite in_app_iff, filter_In. intros [|[]]; auto. apply (H x); simpl; auto.
  - apply IH; auto. intros y Y. apply H. simpl; auto.
Qed.

Lemma enter_well seen batch c : incl (seen ++ batch) scene -> NoDup (seen ++ batch) ->
  kept_well seen c -> kept_well (seen ++ batch) (enter c batch).
Proof.
  intros I N K. unfold Contest.enter. set (pairs := filter (possible a) batch).
  destruct (nearest_sure_is pairs (farthest c)) as [A B].
  set (f := nearest_sure a start end_ (farthest c) pairs) in *.
  assert (P : incl pairs (seen ++ batch)).
  { intros s H. apply filter_In in H. apply in_or_app. tauto. }
  constructor; simpl.
  - destruct A as [A|[w [W [S E]]]].
    + rewrite A. destruct (kept_nearest _ _ K) as [|[w [W S]]]; auto.
      right. exists w. rewrite in_app_iff. tauto.
    + right. exists w. repeat split; auto. apply in_or_app. right. apply filter_In. split; auto.
      destruct (sure_is_met w (I _ (P _ W)) S) as [M [_ [_ [h [H [T [Fh L]]]]]]].
      rewrite (met_not_outside _ M). simpl. unfold less_eq. rewrite <- E, H.
      destruct (less (Finite h) (low w)) eqn:C; auto.
      apply (low_above h w M Fh) in C. lra.
  - intros s H M. apply in_app_or in H. destruct H as [H|H].
    + destruct (kept_all _ _ K s H M) as [|D]; [left; apply in_or_app; auto | right; auto].
    + destruct (less f (low s)) eqn:D; auto. left. apply in_or_app. right.
      apply filter_In. split; [apply filter_In; split; auto; now apply met_possible|].
      rewrite (met_not_outside _ M). unfold less_eq. now rewrite D.
  - intros s H. apply in_app_or in H. destruct H as [H|H].
    + apply in_or_app. left. now apply (kept_some _ _ K).
    + apply filter_In in H. apply P. tauto.
  - assert (N' : NoDup batch /\ NoDup seen /\ forall x, In x seen -> ~ In x batch).
    { clear - N. induction seen as [|x seen IH]; simpl in *.
      - repeat split; auto. constructor.
      - inversion N; subst. destruct (IH H2) as [A [B C]]. repeat split; auto.
        + constructor; auto. intros H. apply H1. apply in_or_app; auto.
        + intros y [E|Y] Z; [subst; apply H1; apply in_or_app; auto | now apply (C y)]. }
    destruct N' as [N1 [N2 N3]]. apply NoDup_join.
    + apply (kept_once _ _ K).
    + now apply NoDup_filter.
    + intros x X Y. apply filter_In in Y. apply (N3 x); [now apply (kept_some _ _ K) | tauto].
Qed.

Local Notation final := (fold_left enter batches nothing_yet).

Lemma final_well : kept_well (concat batches) final.
Proof.
  assert (H : forall rest seen c, incl (seen ++ concat rest) scene -> NoDup (seen ++ concat rest) ->
    kept_well seen c -> kept_well (seen ++ concat rest) (fold_left enter rest c)).
  { induction rest as [|batch rest IH]; intros seen c I N K; simpl.
    - now rewrite app_nil_r.
    - simpl in I, N. rewrite app_assoc in *. apply IH; auto. apply enter_well; auto.
      + intros x X. apply I. apply in_or_app; auto.
      + clear - N. induction (seen ++ batch) as [|x l IH]; [constructor|].
        simpl in N. inversion N; subst. constructor; auto.
        intros H. apply H1. apply in_or_app; auto. }
  apply (H batches [] nothing_yet).
  - apply (proposed_some F).
  - apply (proposed_once F).
  - constructor; simpl; auto; try easy. constructor.
Qed.

(** What remains is of the scene, once; whatever else is met is behind what surely is. *)
Lemma those_some s : In s those -> In s scene.
Proof.
  intros H. apply filter_In in H. apply (proposed_some F), (kept_some _ _ final_well). tauto.
Qed.
Lemma those_once : NoDup those.
Proof. apply NoDup_filter, (kept_once _ _ final_well). Qed.
Lemma met_or_behind s : met s ->
  In s those \/ exists w, In w those /\ SURE w = true /\ t r w < t r s.
Proof.
  intros M. assert (K := final_well).
  destruct (less (farthest final) (low s)) eqn:L.
  - right. destruct (kept_nearest _ _ K) as [E|[w [W [S E]]]]; [now rewrite E in L|].
    assert (I : In w scene) by (apply (proposed_some F), (kept_some _ _ K), W).
    destruct (sure_is_met w I S) as [Mw [_ [_ [h [H [T [Fh Lw]]]]]]].
    exists w. rewrite <- E, H in L. assert (h < t r s) by now apply low_above.
    repeat split; auto; try lra. apply filter_In. split; auto. unfold less_eq.
    rewrite <- E, H. destruct (less (Finite h) (low w)) eqn:C; auto.
    apply (low_above h w Mw Fh) in C. lra.
  - left. apply filter_In. unfold less_eq. rewrite L. split; auto.
    destruct (kept_all _ _ K s (proposed_all F _ M) M) as [|D]; auto. congruence.
Qed.

(** ** A clear answer is the moved ray's, too, and that has one answer *)

Lemma clear_moved o : clearly_sees o -> moved_sees o.
Proof.
  destruct o as [s|]; simpl.
  - intros [M [W A]]. assert (V := moved_stays_inside F _ M W). split.
    + destruct M as [I [C R]]. repeat split; auto; try apply R. now apply closed_D.
    + intros s' M' N. left. assert (E := moved_meets_met _ M'). destruct M' as [_ [V' _]].
      apply (moved_keeps_order F); auto.
  - intros A s M. apply (A s). now apply moved_meets_met.
Qed.
Lemma moved_unique o o' : moved_sees o -> moved_sees o' -> o = o'.
Proof.
  destruct o as [s|], o' as [s'|]; simpl; auto.
  - intros [M A] [M' A']. f_equal.
    destruct (same_or_not s s') as [|N]; [apply M | apply M' | auto |]. exfalso.
    assert (Q : s' <> s) by congruence.
    specialize (A _ M' Q). specialize (A' _ M N).
    assert (V := within_D _ _ (proj1 (proj2 M))). assert (V' := within_D _ _ (proj1 (proj2 M'))).
    destruct A as [A|[A B]], A' as [A'|[A' B']]; try lra.
    + rewrite (same_plane_t moved _ _ A' V) in A. lra.
    + rewrite (same_plane_t moved _ _ A V') in A'. lra.
    + now apply (not_both_before s s').
  - intros [M _] A. now destruct (A s).
  - intros A [M _]. now destruct (A s').
Qed.

(** ** By bound *)

Lemma sole_sure s : those = [s] -> SURE s = true -> clearly_sees (Some s).
Proof.
  intros E S. assert (I : In s those) by (rewrite E; simpl; auto).
  destruct (sure_is_met s (those_some _ I) S) as [M [W _]]. split; [exact M|].
  split; [exact W|]. intros s' M' N.
  destruct (met_or_behind s' M') as [H|[w [H [_ L]]]]; rewrite E in H;
    destruct H as [H|[]]; subst; auto. now destruct N.
Qed.
Lemma none_left : those = [] -> clearly_sees None.
Proof. intros E s M. destruct (met_or_behind s M) as [H|[w [H _]]]; rewrite E in H; destruct H. Qed.

End Nearest.
