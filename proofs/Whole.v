(** The whole: what [plain] says of a ray is true, in whatever batches it sees the scene.

    The words of the theorem are defined in [Facts.v], as are its premises; the model of the tracer
    is in [Contest.v]. Why it holds, in words: *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Contest Facts Nearest Settle Tournament.
Import ListNotations.
Open Scope R_scope.

(** - A surface is dropped only where its t surely is greater than that of a sure hit, which is kept.
      So the nearest is among those that are left, and whatever else is met is behind one that
      surely is, strictly ([Nearest.v]).
    - If one is left, and is sure, all else is behind it: BOUND.
    - If all who are left are sure, a tournament by [order_of] finds the nearest, and all in its
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
  assert (Entry : forall o k, moved_sees r moved start end_ scene o ->
    match k with
    | BOUND | EXACT => clearly_sees r start end_ scene o
    | AMBIGUOUS => forall answer, ~ clearly_sees r start end_ scene answer
    end ->
    let result := entry a o k in
    moved_sees r moved start end_ scene (owner result) /\
    match certain result with
    | BOUND | EXACT => clearly_sees r start end_ scene (owner result)
    | AMBIGUOUS => forall answer, ~ clearly_sees r start end_ scene answer
    end /\
    t_of_owner result =
      match owner result with Some s => Some (nearest_float (t r s)) | None => None end).
  { intros o k M C. simpl. split; [exact M|]. split; [exact C|]. destruct o as [s|]; auto. simpl.
    destruct M as [M _]. now rewrite (t_right F _ (moved_meets_met F _ M)). }
  assert (Integers : let result := by_integers a (found a start c) in
    moved_sees r moved start end_ scene (owner result) /\
    match certain result with
    | BOUND | EXACT => clearly_sees r start end_ scene (owner result)
    | AMBIGUOUS => forall answer, ~ clearly_sees r start end_ scene answer
    end /\
    t_of_owner result =
      match owner result with Some s => Some (nearest_float (t r s)) | None => None end).
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
    destruct (rounds _ _ _) as [[w tied]|] eqn:R; [|exact Integers].
    destruct (by_order_right F O S w tied R) as [M C]. apply Entry; auto.
    destruct tied; auto.
Qed.

Print Assumptions plain_is_right.
