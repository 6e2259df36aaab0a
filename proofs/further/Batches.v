(** The order in which a contest sees its pairs changes nothing of its result, certainty included.

    [always_the_same] has all but whether a bound was enough: that is so where what is left is
    nothing, or one that is sure; and what is left does not depend on the order. *)
Require Import ZArith Reals Psatz List Bool Permutation.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Contest Facts Nearest Whole.
Import ListNotations.
Open Scope R_scope.

Section Batches.
Variables (start : R) (end_ : number) (a : answers).

Local Notation high := (high a).
Local Notation low := (low a start).
Local Notation SURE := (SURE a start end_).
Local Notation outside := (outside a start end_).
Local Notation enter := (enter a start end_).

Lemma less_both f g x : less g f = true -> less x g = true -> less x f = true.
Proof. intros A B. now apply (less_weaken g x f). Qed.
Lemma not_less_same f g : less f g = false -> less g f = false -> f = g.
Proof.
  destruct f as [|f|], g as [|g|]; simpl; auto; try discriminate.
  do 2 case Rlt_bool_spec; intros; try discriminate. f_equal. lra.
Qed.

Lemma nearest_sure_least pairs : forall f, let g := nearest_sure a start end_ f pairs in
  (forall x, less x g = true -> less x f = true) /\
  (forall w, In w pairs -> SURE w = true -> less (high w) g = false).
Proof.
  induction pairs as [|s pairs IH]; intros f g; simpl in g.
  - unfold g. simpl. split; auto. easy.
  - destruct (SURE s) eqn:S.
    + destruct (IH (least f (high s))) as [A B]. fold g in A, B. unfold least in A.
      split.
      * intros x X. apply A in X. destruct (less (high s) f) eqn:L; auto.
        now apply (less_both f (high s)).
      * intros w [W|W] Sw; [subst w | now apply B].
        destruct (less (high s) g) eqn:L; auto. apply A in L.
        destruct (less (high s) f) eqn:M; [|congruence]. now rewrite less_irrefl in L.
    + destruct (IH f) as [A B]. fold g in A, B. split; auto.
      intros w [W|W] Sw; [congruence | now apply B].
Qed.

(** What a contest knows after all that it has seen: no matter in which order. *)
Definition may_be (s : surface) : Prop := possible a s = true /\ outside s = false.
Record knows (seen : list surface) (c : contest) : Prop := {
  nearest_seen : farthest c = Infinity \/
    exists w, In w seen /\ possible a w = true /\ SURE w = true /\ high w = farthest c;
  nearest_least : forall w, In w seen -> possible a w = true -> SURE w = true ->
    less (high w) (farthest c) = false;
  kept_seen : forall s, In s (kept c) -> In s seen /\ may_be s;
  seen_kept : forall s, In s seen -> may_be s -> In s (kept c) \/ less (farthest c) (low s) = true
}.

Lemma enter_knows seen c batch : knows seen c -> knows (seen ++ batch) (enter c batch).
Proof.
  intros K. unfold Contest.enter. set (pairs := filter (possible a) batch).
  destruct (nearest_sure_is (start := start) (end_ := end_) (a := a) pairs (farthest c)) as [A B].
  destruct (nearest_sure_least pairs (farthest c)) as [A' B'].
  set (f := nearest_sure a start end_ (farthest c) pairs) in *.
  assert (P : forall s, In s pairs <-> In s batch /\ possible a s = true)
    by (intros; apply filter_In).
  constructor; simpl.
  - destruct A as [A|[w [W S]]].
    + rewrite A. destruct (nearest_seen _ _ K) as [|[w [W S]]]; auto.
      right. exists w. rewrite in_app_iff. tauto.
    + right. exists w. apply P in W. rewrite in_app_iff. tauto.
  - intros w W Q S. apply in_app_or in W. destruct W as [W|W].
    + destruct (less (high w) f) eqn:L; auto. apply A' in L.
      now rewrite (nearest_least _ _ K w W Q S) in L.
    + apply B'; auto. now apply P.
  - intros s H. apply in_app_or in H. rewrite in_app_iff. destruct H as [H|H].
    + apply (kept_seen _ _ K) in H. tauto.
    + apply filter_In in H. destruct H as [H L]. apply P in H. apply andb_prop in L.
      destruct L as [L _]. apply negb_true_iff in L. unfold may_be. tauto.
  - intros s H M. rewrite in_app_iff. apply in_app_or in H. destruct H as [H|H].
    + destruct (seen_kept _ _ K s H M); auto.
    + destruct (less f (low s)) eqn:L; auto. left. right. apply filter_In.
      split; [apply P; split; auto; apply M|]. unfold less_eq. now rewrite L, (proj2 M).
Qed.

Lemma plain_knows batches : knows (concat batches) (fold_left enter batches nothing_yet).
Proof.
  assert (G : forall rest seen c, knows seen c ->
    knows (seen ++ concat rest) (fold_left enter rest c)).
  { induction rest as [|batch rest IH]; intros seen c K; simpl; [now rewrite app_nil_r|].
    rewrite app_assoc. now apply IH, enter_knows. }
  apply (G batches [] nothing_yet). constructor; simpl; auto; easy.
Qed.

Lemma found_is batches s : let c := fold_left enter batches nothing_yet in
  In s (found a start c) <->
  In s (concat batches) /\ may_be s /\ less (farthest c) (low s) = false.
Proof.
  simpl. assert (K := plain_knows batches). unfold found. rewrite filter_In.
  unfold less_eq. rewrite negb_true_iff. split.
  - intros [H L]. apply (kept_seen _ _ K) in H. tauto.
  - intros [H [M L]]. split; auto. destruct (seen_kept _ _ K s H M); auto. congruence.
Qed.

Lemma farthest_same batches batches' : Permutation (concat batches) (concat batches') ->
  farthest (fold_left enter batches nothing_yet) = farthest (fold_left enter batches' nothing_yet).
Proof.
  intros Q. assert (K := plain_knows batches). assert (K' := plain_knows batches').
  assert (In_both : forall s, In s (concat batches) <-> In s (concat batches')).
  { intros s. split; apply Permutation_in; auto. now apply Permutation_sym. }
  apply not_less_same.
  - destruct (nearest_seen _ _ K) as [I|[w [W [P [S H]]]]];
      [rewrite I; destruct (farthest _); auto|].
    rewrite <- H. apply (nearest_least _ _ K'); auto. now apply In_both.
  - destruct (nearest_seen _ _ K') as [I|[w [W [P [S H]]]]];
      [rewrite I; destruct (farthest _); auto|].
    rewrite <- H. apply (nearest_least _ _ K); auto. now apply In_both.
Qed.

(** A bound is enough for nothing, and for one that is sure. *)
Lemma by_bound_is c : certain (hits a start end_ c) = BOUND <->
  (found a start c = [] \/ exists s, found a start c = [s] /\ SURE s = true).
Proof.
  assert (I : forall l, certain (by_integers a l) <> BOUND).
  { intros l. unfold by_integers. simpl. destruct (no_ties _ _); discriminate. }
  unfold hits. destruct (found a start c) as [|s [|s' rest]].
  - simpl. tauto.
  - destruct (SURE s) eqn:S; split; intros H; auto.
    + right. now exists s.
    + now destruct (I [s]).
    + destruct H as [H|[x [H K]]]; [discriminate|]. inversion H; subst. congruence.
  - split; [|intros [H|[x [H _]]]; discriminate]. intros H. exfalso. revert H.
    destruct (_ && _); [|apply I].
    unfold by_order. destruct (nearest_of _ _) as [[w tied]|]; [|apply I].
    simpl. destruct tied; discriminate.
Qed.
End Batches.

Theorem order_does_not_matter r moved start end_ scene batches batches' a :
  facts r moved start end_ scene batches a -> facts r moved start end_ scene batches' a ->
  Permutation (concat batches) (concat batches') ->
  plain a start end_ batches = plain a start end_ batches'.
Proof.
  intros F F' Q. destruct (always_the_same _ _ _ _ _ _ _ _ _ F F') as [O [T A]].
  assert (B : forall b b', Permutation (concat b) (concat b') ->
    facts r moved start end_ scene b a -> facts r moved start end_ scene b' a ->
    certain (plain a start end_ b) = BOUND -> certain (plain a start end_ b') = BOUND).
  { intros b b' P Fb Fb'. unfold plain. rewrite !by_bound_is.
    assert (S : forall s, In s (found a start (fold_left (enter a start end_) b nothing_yet)) <->
      In s (found a start (fold_left (enter a start end_) b' nothing_yet))).
    { intros s. rewrite !found_is, (farthest_same start end_ a b b' P).
      assert (In s (concat b) <-> In s (concat b')); [|tauto].
      split; apply Permutation_in; auto. now apply Permutation_sym. }
    intros [H|[s [H K]]].
    - left. destruct (found a start (fold_left _ b' _)) as [|x l]; auto.
      exfalso. assert (I : In x (x :: l)) by (simpl; auto). apply S in I. now rewrite H in I.
    - right. exists s. split; auto. apply Permutation_length_1_inv.
      apply NoDup_Permutation.
      + repeat constructor. easy.
      + apply (those_once Fb').
      + intros x. now rewrite <- S, H. }
  assert (B1 := B _ _ Q F F'). assert (B2 := B _ _ (Permutation_sym Q) F' F).
  destruct (plain a start end_ batches) as [o c t_], (plain a start end_ batches') as [o' c' t'].
  simpl in *. subst. f_equal. destruct c, c'; try tauto; try (now rewrite B1); try (now rewrite B2);
    try (assert (X : EXACT = AMBIGUOUS) by (apply A; auto); discriminate).
Qed.
