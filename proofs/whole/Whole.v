(** The whole: what [plain] says of a ray is true, in whatever batches it sees the scene.

    Here the moved ray is one that is near enough; [Nearby.v] says the same of all that are.

    The words of the theorem are defined in [Facts.v], as are its premises; the model of the tracer
    is in [Contest.v]. Why it holds, in words: *)
Require Import ZArith Reals Psatz List Bool Classical ClassicalDedekindReals.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Contest Facts Nearest Settle Tournament.
Import ListNotations.
Open Scope R_scope.

(** - A surface is dropped only where its t surely is greater than that of a sure hit, which is
      kept. So the nearest is among those that are left, and whatever else is met is behind one
      that surely is, strictly ([Nearest.v]).
    - If one is left, and is sure, all else is behind it: BOUND.
    - If all who are left are sure, comparing them by [order_of] finds the nearest, and all in its
      plane ([Tournament.v]).
    - Else integers say who is met, and who is the nearest of the moved ray; what is met at no edge,
      strictly before all else, is that ([Settle.v]). *)
Theorem plain_is_right r moved start end_ scene batches a :
  facts r moved start end_ scene batches a ->
  let result := plain a start end_ batches in
  (* The owner is what the moved ray sees. *)
  moved_sees r moved start end_ scene (owner result) /\
  (* By a bound or by integers: it is what the stored ray sees, and no rule was needed. Else the
     stored ray alone has no clear answer. *)
  match certain result with
  | BOUND | EXACT => clearly_sees r start end_ scene (owner result)
  | AMBIGUOUS => forall answer, ~ clearly_sees r start end_ scene answer
  end /\
  (* t is T / D, rounded once. *)
  t_of_owner result =
    match owner result with Some s => Some (nearest_float (t r s)) | None => None end.
Proof.
  intros F. simpl. unfold plain.
  set (c := fold_left (enter a start end_) batches nothing_yet).
  set (right := fun result =>
    moved_sees r moved start end_ scene (owner result) /\
    match certain result with
    | BOUND | EXACT => clearly_sees r start end_ scene (owner result)
    | AMBIGUOUS => forall answer, ~ clearly_sees r start end_ scene answer
    end /\
    t_of_owner result =
      match owner result with Some s => Some (nearest_float (t r s)) | None => None end).
  change (right (hits a start end_ c)).
  assert (Entry : forall o k, moved_sees r moved start end_ scene o ->
    match k with
    | BOUND | EXACT => clearly_sees r start end_ scene o
    | AMBIGUOUS => forall answer, ~ clearly_sees r start end_ scene answer
    end -> right (entry a o k)).
  { intros o k M C. split; [exact M|]. split; [exact C|]. destruct o as [s|]; auto. simpl.
    destruct M as [M _]. now rewrite (t_right F _ (moved_meets_met F _ M)). }
  assert (Integers : right (by_integers a (found a start c))).
  { apply Entry; [exact (first_moved F)|]. generalize (ties_right F). fold c.
    destruct (no_ties a (filter (hit a) (found a start c))); auto. }
  unfold hits. destruct (found a start c) as [|s [|s' rest]] eqn:E.
  - assert (C := none_left F E). apply Entry; auto. now apply (clear_moved F).
  - destruct (SURE a start end_ s) eqn:S; [|exact Integers].
    assert (C := sole_sure F s E S). apply Entry; auto. now apply (clear_moved F).
  - destruct (order_applies a && forallb (SURE a start end_) (s :: s' :: rest)) eqn:O;
      [|exact Integers].
    apply andb_prop in O. destruct O as [O S]. rewrite forallb_forall in S.
    unfold by_order. rewrite <- E in *.
    destruct (nearest_of _ _) as [[w tied]|] eqn:R; [|exact Integers].
    destruct (by_order_right F O S w tied R) as [M C]. apply Entry; auto.
    destruct tied; auto.
Qed.

(** However the pairs are batched, and whatever the bounds leave open: the owner, its t, and
    whether a rule was needed are the same. *)
Corollary always_the_same r moved start end_ scene batches a batches' a' :
  facts r moved start end_ scene batches a -> facts r moved start end_ scene batches' a' ->
  let one := plain a start end_ batches in
  let other := plain a' start end_ batches' in
  owner one = owner other /\ t_of_owner one = t_of_owner other /\
  (certain one = AMBIGUOUS <-> certain other = AMBIGUOUS).
Proof.
  intros F F' one other.
  destruct (plain_is_right _ _ _ _ _ _ _ F) as [O [C T]]. fold one in O, C, T.
  destruct (plain_is_right _ _ _ _ _ _ _ F') as [O' [C' T']]. fold other in O', C', T'.
  assert (E := moved_unique F _ _ O O'). split; [exact E|]. split; [now rewrite T, T', E|].
  destruct (certain one), (certain other); split; intros Q; try discriminate; auto; exfalso;
    (eapply C; eassumption) || (eapply C'; eassumption).
Qed.

(** The premises do not contradict one another: answers that leave everything to integers, which
    say what is so, fulfil them, for every scene with a moved ray that is near enough. *)
Theorem facts_are_possible r moved start end_ scene batches :
  (forall s s', In s scene -> In s' scene -> called s = called s' -> s = s') ->
  match end_ with Finite e => float64 e | Infinity => True | MinusInfinity => False end ->
  (forall s, met r start end_ scene s -> In s (concat batches)) ->
  NoDup (concat batches) -> incl (concat batches) scene ->
  (forall s, met r start end_ scene s -> meets_within r s -> meets_within moved s) ->
  (forall s s', met r start end_ scene s -> met r start end_ scene s' ->
    meets_within moved s -> meets_within moved s' ->
    (t r s < t r s' -> t moved s < t moved s') /\ (t moved s = t moved s' -> same_plane s s')) ->
  (forall s, In s scene -> meets_within moved s -> D r s <> 0 -> meets_closed r s) ->
  exists a, facts r moved start end_ scene batches a.
Proof.
  intros N E A O I S K M.
  set (is := fun P : Prop => if sig_not_dec P then true else false).
  assert (Is : forall P, is P = true <-> P).
  { intros P. unfold is. destruct (sig_not_dec P); split; auto; try easy.
    intros _. now apply NNPP. }
  exists (Answers (fun _ => true) (fun _ => false) (fun _ => MinusInfinity) (fun _ => Infinity)
    false (fun _ _ => UNDECIDED) false (fun s => is (met r start end_ scene s))
    (fun s => negb (is (meets_within r s))) (fun s => is (meets_within moved s))
    (fun s s' => Rcompare (t r s) (t r s')) (fun s s' => Rcompare (t moved s) (t moved s'))
    (fun s => nearest_float (t r s))).
  split; constructor; simpl; auto; try easy.
  - intros s _. rewrite negb_false_iff. apply Is.
  - intros s s' Hs Hs' V V'. case Rcompare_spec; auto. now apply K.
  - intros s s' Hs Hs' V V'. now apply K.
Qed.

