(** Which is the nearest of those that surely are met, with all in its plane: compared one after the
    other, or in the rounds of a tournament. *)
Require Import ZArith Reals Psatz List Bool Sorted Permutation.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Contest Facts Nearest.
Import ListNotations.
Open Scope R_scope.

Section Order.
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
Let met_in : forall s, met s -> In s scene := met_in.
Let met_D : forall s, met s -> D r s <> 0 := met_D.

(** If all pairs are decided, somebody is found. *)
Lemma one_by_one_ends : (forall s s', order_of a s s' <> UNDECIDED) -> forall l, l <> [] ->
  exists e, one_by_one a l = Some e.
Proof.
  intros D [|first rest] N; [easy|]. simpl. clear N. revert first.
  induction rest as [|other rest IH]; intros first; [now exists first|]. simpl. unfold meet at 2.
  specialize (D (fst first) (fst other)).
  destruct (order_of a (fst first) (fst other)); try (now destruct D); apply IH; easy.
Qed.
Lemma round_shrinks : (forall s s', order_of a s s' <> UNDECIDED) ->
  forall n l, (length l <= n)%nat ->
  exists l', round a l = Some l' /\ (length l' <= length l)%nat /\
    (l <> [] -> l' <> []) /\ (2 <= length l -> length l' < length l)%nat.
Proof.
  intros D. induction n as [|n IH]; intros l L.
  - destruct l; [|simpl in L; lia]. exists []. simpl. repeat split; auto; lia.
  - destruct l as [|one [|other rest]]; [exists [] | exists [one] |]; simpl;
      try (repeat split; auto; lia).
    destruct (IH rest) as [others [E [S _]]]; [simpl in L; lia|]. rewrite E. unfold meet.
    specialize (D (fst one) (fst other)).
    destruct (order_of a (fst one) (fst other)); try (now destruct D); eexists;
      (split; [reflexivity|]); simpl; repeat split; try easy; lia.
Qed.
Lemma tournament_ends : (forall s s', order_of a s s' <> UNDECIDED) -> forall n l, l <> [] ->
  (length l <= n)%nat -> exists e, rounds a n l = Some e.
Proof.
  intros D. induction n as [|n IH]; intros l N L.
  - destruct l; [easy | simpl in L; lia].
  - destruct l as [|one [|other rest]]; [easy | now exists one |].
    change (exists e, match round a (one :: other :: rest) with
      Some fewer => rounds a n fewer | None => None end = Some e).
    destruct (round_shrinks D (S n) (one :: other :: rest) L) as [l' [E [_ [K S]]]]. rewrite E.
    apply IH; [now apply K|]. simpl in S, L. lia.
Qed.

Hypothesis applies : order_applies a = true.
Hypothesis all_sure : forall s, In s those -> SURE s = true.

(** What each comparison keeps true of those who are left: of all that there were at the beginning,
    each is left, or with one who is, in one plane, or behind one who is. *)
Definition members (e : entrant) : list surface := fst e :: snd e.
Definition stands_for (e : entrant) (s : surface) : Prop := In s (members e) \/ t r (fst e) < t r s.
Definition sound (e : entrant) : Prop :=
  In (fst e) those /\
  forall x, In x (snd e) -> In x those /\ same_plane (fst e) x /\ before (fst e) x = true.
Definition all_before (e e' : entrant) : Prop :=
  forall x y, In x (members e) -> In y (members e') -> before x y = true.

Lemma t_of_members e s : sound e -> In s (members e) -> t r s = t r (fst e).
Proof.
  intros [_ S] [H|H]; [now subst|]. destruct (S _ H) as [I [P _]]. symmetry.
  apply same_plane_t; auto. apply met_D. now apply (sure_is_met F s (those_some F _ I)), all_sure.
Qed.

Lemma meet_right one other e : meet a one other = Some e ->
  sound one -> sound other -> all_before one other ->
  sound e /\ incl (members e) (members one ++ members other) /\
  forall s, stands_for one s \/ stands_for other s -> stands_for e s.
Proof.
  intros E S S' B. unfold meet in E.
  destruct (sure_is_met F _ (those_some F _ (proj1 S)) (all_sure _ (proj1 S))) as [M [W [Q _]]].
  destruct (sure_is_met F _ (those_some F _ (proj1 S')) (all_sure _ (proj1 S')))
    as [M' [W' [Q' _]]].
  assert (O := order_right F applies _ _ (met_in _ M) (met_in _ M') W W' Q Q').
  unfold stands_for in *.
  destruct (order_of a (fst one) (fst other)); inversion E; subst; clear E.
  - split; [exact S|]. split; [apply incl_appl, incl_refl|].
    intros s [[H|H]|[H|H]]; auto; right; [|lra]. now rewrite (t_of_members _ _ S' H).
  - assert (P : t r (fst one) = t r (fst other)) by (apply same_plane_t; auto; now apply met_D).
    split; [split; simpl; [exact (proj1 S)|]|split].
    + intros x X. apply in_app_or in X. destruct X as [X|[X|X]].
      * now apply (proj2 S).
      * subst x. split; [exact (proj1 S')|]. split; auto. apply B; simpl; auto.
      * destruct (proj2 S' x X) as [I [R N]]. split; auto.
        split; [now apply (same_plane_trans _ (fst other))|]. apply B; simpl; auto.
    + intros x X. simpl in X |- *. rewrite in_app_iff in *. simpl in *. tauto.
    + unfold members. simpl. intros s H. rewrite in_app_iff. simpl in *.
      rewrite P. destruct H as [[[H|H]|H]|[[H|H]|H]]; try rewrite P in H; auto; tauto.
  - split; [exact S'|]. split; [apply incl_appr, incl_refl|].
    intros s [[H|H]|[H|H]]; auto; right; [|lra]. now rewrite (t_of_members _ _ S H).
Qed.

Lemma round_right l : forall l', round a l = Some l' ->
  Forall sound l -> StronglySorted all_before l ->
  Forall sound l' /\ StronglySorted all_before l' /\
  (forall x, In x (flat_map members l') -> In x (flat_map members l)) /\
  forall s, Exists (fun e => stands_for e s) l -> Exists (fun e => stands_for e s) l'.
Proof.
  assert (G : forall n l l', (length l <= n)%nat -> round a l = Some l' ->
    Forall sound l -> StronglySorted all_before l ->
    Forall sound l' /\ StronglySorted all_before l' /\
    (forall x, In x (flat_map members l') -> In x (flat_map members l)) /\
    forall s, Exists (fun e => stands_for e s) l -> Exists (fun e => stands_for e s) l').
  { clear l. induction n as [|n IH]; intros l l' L E S O.
    - destruct l; [|simpl in L; lia]. inversion E; subst. auto.
    - destruct l as [|one [|other rest]]; [inversion E; subst; auto ..|]. simpl in E.
      destruct (meet a one other) as [e|] eqn:Em; [|discriminate].
      destruct (round a rest) as [others|] eqn:Er; [|discriminate]. inversion E; subst; clear E.
      inversion S as [|? ? S1 S']; subst. inversion S' as [|? ? S2 S3]; subst.
      inversion O as [|? ? O' B1]; subst. inversion O' as [|? ? O3 B2]; subst.
      inversion B1 as [|? ? B12 B13]; subst.
      destruct (meet_right _ _ _ Em S1 S2 B12) as [Se [I St]].
      destruct (IH rest others) as [S4 [O4 [I4 St4]]]; auto; [simpl in L; lia|].
      split; [now constructor|]. split; [|split].
      + constructor; auto. apply Forall_forall. intros e' He' x y X Y.
        assert (J : In y (flat_map members rest)) by (apply I4, in_flat_map; now exists e').
        apply in_flat_map in J. destruct J as [e'' [J K]].
        rewrite Forall_forall in B13, B2. apply I in X. apply in_app_or in X.
        destruct X as [X|X]; [now apply (B13 e'') | now apply (B2 e'')].
      + intros x X. change (In x (members e ++ flat_map members others)) in X.
        change (In x (members one ++ members other ++ flat_map members rest)).
        apply in_app_or in X. rewrite !in_app_iff. destruct X as [X|X].
        * apply I, in_app_or in X. tauto.
        * apply I4 in X. tauto.
      + intros s H. inversion H as [? ? K|? ? K]; subst; [apply Exists_cons_hd, St; auto|].
        inversion K as [? ? K'|? ? K']; subst; [apply Exists_cons_hd, St; auto|].
        now apply Exists_cons_tl, St4. }
  intros l'. now apply (G (length l)).
Qed.

Lemma rounds_right n : forall l e, rounds a n l = Some e ->
  Forall sound l -> StronglySorted all_before l ->
  sound e /\ forall s, Exists (fun e => stands_for e s) l -> stands_for e s.
Proof.
  assert (One : forall e0 e, Some e0 = Some e -> Forall sound [e0] ->
    sound e /\ forall s, Exists (fun e => stands_for e s) [e0] -> stands_for e s).
  { intros e0 e E S. inversion E; subst. inversion S; subst. split; auto.
    intros s H. inversion H as [? ? K|? ? K]; subst; auto. inversion K. }
  induction n as [|n IH]; intros l e E So O.
  { destruct l as [|one [|other rest]]; [discriminate E | now apply One | discriminate E]. }
  destruct l as [|one [|other rest]]; [now apply (IH []) | now apply One |].
  change (rounds a (S n) (one :: other :: rest)) with
    (match round a (one :: other :: rest) with
     | Some fewer => rounds a n fewer
     | None => None
     end) in E.
  destruct (round a (one :: other :: rest)) as [l'|] eqn:R; [|discriminate].
  destruct (round_right _ _ R So O) as [S' [O' [_ St]]].
  destruct (IH _ _ E S' O') as [A B]. split; auto.
Qed.

Lemma one_by_one_right l e : one_by_one a l = Some e ->
  Forall sound l -> StronglySorted all_before l ->
  sound e /\ forall s, Exists (fun e => stands_for e s) l -> stands_for e s.
Proof.
  destruct l as [|first rest]; [discriminate|]. simpl. revert first.
  induction rest as [|other rest IH]; intros first E S O.
  { inversion E; subst. inversion S; subst. split; auto. intros s H.
    inversion H as [? ? K|? ? K]; subst; auto. inversion K. }
  simpl in E. destruct (meet a first other) as [b|] eqn:Em.
  2: { exfalso. clear - E. induction rest as [|x rest IH]; [discriminate E | now apply IH]. }
  inversion S as [|? ? S1 S']; subst. inversion S' as [|? ? S2 S3]; subst.
  inversion O as [|? ? O' B1]; subst. inversion O' as [|? ? O3 B2]; subst.
  inversion B1 as [|? ? B12 B13]; subst.
  destruct (meet_right _ _ _ Em S1 S2 B12) as [Sb [I St]].
  destruct (IH b E) as [Se K]; [now constructor | |].
  - constructor; auto. rewrite Forall_forall in *. intros y Y u v U V. apply I in U.
    apply in_app_or in U. destruct U as [U|U]; [now apply (B13 y) | now apply (B2 y)].
  - split; auto. intros s H. apply K.
    inversion H as [? ? H1|? ? H1]; subst; [apply Exists_cons_hd, St; auto|].
    inversion H1 as [? ? H2|? ? H2]; subst; [apply Exists_cons_hd, St; auto|].
    now apply Exists_cons_tl.
Qed.
Lemma nearest_of_right l e : nearest_of a l = Some e ->
  Forall sound l -> StronglySorted all_before l ->
  sound e /\ forall s, Exists (fun e => stands_for e s) l -> stands_for e s.
Proof.
  unfold nearest_of. destruct (two_by_two a); [apply rounds_right | apply one_by_one_right].
Qed.

Lemma insert_sorted s l : In s scene -> incl l scene -> ~ In s l ->
  StronglySorted (fun x y => before x y = true) l ->
  StronglySorted (fun x y => before x y = true) (insert s l) /\
  forall x, In x (insert s l) <-> x = s \/ In x l.
Proof.
  intros I J N S. induction S as [|y l S IH A]; simpl.
  - split; [repeat constructor|]. intuition congruence.
  - destruct (before y s) eqn:B.
    + destruct IH as [S' P]; [intros x X; apply J; simpl; auto | simpl in N; tauto |].
      split; [|intros x; simpl; rewrite P; intuition].
      constructor; auto. rewrite Forall_forall in *. intros x X. apply P in X.
      destruct X as [X|X]; [now subst | auto].
    + assert (C : before s y = true).
      { destruct (before_total F s y) as [|C]; auto;
          [apply J; simpl; auto | intro; subst; simpl in N; tauto | congruence]. }
      split; [|intros x; simpl; intuition]. constructor; [now constructor|]. constructor; auto.
      rewrite Forall_forall in *. intros x X. apply (before_trans _ y); auto.
Qed.
Lemma by_name_sorted l : incl l scene -> NoDup l ->
  StronglySorted (fun x y => before x y = true) (by_name l) /\
  forall x, In x (by_name l) <-> In x l.
Proof.
  induction l as [|s l IH]; intros I N; simpl; [split; [constructor | tauto]|].
  inversion N; subst. destruct IH as [S P]; auto; [intros x X; apply I; simpl; auto|].
  destruct (insert_sorted s (by_name l)) as [S' P']; auto.
  - apply I. simpl; auto.
  - intros x X. apply I. right. now apply P.
  - now rewrite P.
  - split; auto. intros x. rewrite P', P. intuition.
Qed.

Lemma by_order_right s tied :
  nearest_of a (map (fun s => (s, [])) (by_name those)) = Some (s, tied) ->
  moved_sees (Some s) /\
  match tied with [] => clearly_sees (Some s) | _ => forall o, ~ clearly_sees o end.
Proof.
  intros E.
  destruct (by_name_sorted those) as [S P]; [exact (those_some F) | apply (those_once F) |].
  assert (Sound : Forall sound (map (fun s => (s, [])) (by_name those))).
  { apply Forall_forall. intros e H. apply in_map_iff in H. destruct H as [x [H X]]. subst.
    split; simpl; [now apply P | easy]. }
  assert (Sorted : StronglySorted all_before (map (fun s => (s, [])) (by_name those))).
  { clear E Sound P. induction S as [|x l S IH A]; simpl; constructor; auto.
    rewrite Forall_forall in *. intros e H. apply in_map_iff in H. destruct H as [y [H Y]]. subst.
    intros u v [U|[]] [V|[]]. subst. auto. }
  destruct (nearest_of_right _ _ E Sound Sorted) as [[I T] St]. simpl in I, T.
  assert (Stand : forall x, In x those -> x = s \/ In x tied \/ t r s < t r x).
  { intros x X. destruct (St x) as [[H|H]|H]; simpl in *; auto.
    apply Exists_exists. exists (x, []).
    split; [apply in_map_iff; exists x; split; auto; now apply P|].
    left. simpl; auto. }
  destruct (sure_is_met F s (those_some F _ I) (all_sure _ I)) as [M [W _]].
  assert (A : forall x, met x -> x = s \/ In x tied \/ t r s < t r x).
  { intros x X. destruct (met_or_behind F x X) as [H|[w [H [_ L]]]]; auto.
    right. right. destruct (Stand w H) as [K|[K|K]]; [now subst| |lra].
    destruct (T _ K) as [_ [Q _]]. rewrite (same_plane_t r _ _ Q); auto.
    apply met_D. now apply (sure_is_met F w (those_some F _ H)), all_sure. }
  split.
  - assert (V := moved_stays_inside F _ M W). split.
    + destruct M as [J [C R]]. repeat split; auto; try apply R. now apply closed_D.
    + intros s' M' N. assert (X := moved_meets_met F _ M'). destruct M' as [_ [V' _]].
      destruct (A _ X) as [H|[H|H]]; [congruence | |].
      * right. now split; apply T.
      * left. now apply (moved_keeps_order F).
  - destruct tied as [|x tied].
    + split; [exact M|]. split; [exact W|]. intros s' M' N.
      destruct (A _ M') as [H|[[]|H]]; auto. congruence.
    + destruct (T x) as [Ix [Q B]]; [simpl; auto|].
      destruct (sure_is_met F x (those_some F _ Ix) (all_sure _ Ix)) as [Mx _].
      assert (Tx := same_plane_t r _ _ Q (met_D _ Mx)).
      intros [o|] C; simpl in C; [|now apply (C s)]. destruct C as [Mo [_ C]].
      destruct (same_or_not F o s) as [K|K]; auto using met_in.
      * subst o. apply before_differs in B. specialize (C x Mx (not_eq_sym B)). lra.
      * specialize (C s M (not_eq_sym K)). destruct (A _ Mo) as [H|[H|H]]; [congruence | | lra].
        destruct (T _ H) as [_ [Q' _]]. rewrite (same_plane_t r _ _ Q' (met_D _ Mo)) in C. lra.
Qed.

End Order.
