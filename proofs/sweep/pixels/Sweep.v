(** The sweep's answer is right, too: what it drops surely is behind what it keeps.

    The model is of one pixel, and follows depth_buffer.py, [Sweep.of_pairs] in sweep.py and
    resolve.py. [nearness] is any number that is less for what is farther. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Contest Facts Nearest Whole.
Import ListNotations.
Open Scope R_scope.

(** A surface, and the least and the most that its nearness can be at this pixel. *)
Record fragment := Fragment { of : surface; fewest : number; most : number }.

(** The buffer's winner, and all that may be as near. *)
Record pixel := Pixel { winner : option fragment; rivals : list fragment }.
Definition empty : pixel := Pixel None [].
Definition nearness_of (p : pixel) : number :=
  match winner p with Some w => fewest w | None => MinusInfinity end.

(** [DepthBuffer.enter], of surfaces that the pixel surely hits: one time around its loop. Of the
    nearer ones the last is written and stays; the others come again, the other way round. *)
Definition other_than (x e : fragment) : bool := before (of x) (of e) || before (of e) (of x).
Definition write (p : pixel) (some : list fragment) : pixel * list fragment :=
  let n := nearness_of p in
  let nearer := filter (fun e => less n (fewest e)) some in
  let near := filter (fun e => negb (less n (fewest e) || less (most e) n)) some in
  match rev nearer with
  | [] => (Pixel (winner p) (rivals p ++ near), [])
  | x :: _ =>
      let beaten :=
        match winner p with
        | Some w => if existsb (fun e => negb (less (most w) (fewest e))) nearer then [w] else []
        | None => []
        end in
      (Pixel (Some x) (rivals p ++ near ++ beaten), filter (other_than x) (rev nearer))
  end.
Fixpoint enter_sure (n : nat) (p : pixel) (some : list fragment) : pixel :=
  match n, some with
  | S n, _ :: _ => let (p, again) := write p some in enter_sure n p again
  | _, _ => p
  end.

Definition not_hidden (p : pixel) : list fragment :=
  filter (fun e => negb (less (most e) (nearness_of p))) (rivals p).

(** What happens to a pixel: surfaces that surely are hit are entered; one that may be hit is kept,
    unless it is hidden (as are those which a cell of the buffer hides, or a box, unseen: they are
    behind the least nearness of many pixels); and what is hidden by now is dropped. *)
Inductive event := Sure (some : list fragment) | Open (e : fragment) | MakeRoom.
Definition happen (p : pixel) (e : event) : pixel :=
  match e with
  | Sure some => enter_sure (length some) p some
  | Open e => if less (most e) (nearness_of p) then p else Pixel (winner p) (rivals p ++ [e])
  | MakeRoom => Pixel (winner p) (not_hidden p)
  end.
Definition swept (events : list event) : pixel := fold_left happen events empty.

(** [Resolver]: the winner without rivals is seen; else a contest decides who of all these is. *)
Definition handed_over (p : pixel) : list surface :=
  match winner p with Some w => [of w] | None => [] end ++ map of (not_hidden p).
Definition verdict (events : list event) (of_contest : result) : option surface * certainty :=
  let p := swept events in
  match not_hidden p with
  | [] => (option_map of (winner p), BOUND)
  | _ => (owner of_contest, certain of_contest)
  end.

Definition from_below (x : number) (y : R) : Prop := (* x <= y *)
  match x with MinusInfinity => True | Finite x => x <= y | Infinity => False end.
Definition from_above (x : number) (y : R) : Prop := (* y <= x *)
  match x with MinusInfinity => False | Finite x => y <= x | Infinity => True end.

Section Sweep.
Context {r moved : ray} {start : R} {end_ : number} {scene : list surface}.
Context {batches : list (list surface)} {a : answers}.
Hypothesis P : facts r moved start end_ scene batches a.
Variable nearness : surface -> R.
Variable events : list event.

Local Notation met := (met r start end_ scene).

(** What happens is right, one by one. *)
Definition right_about (e : event) : Prop :=
  match e with
  | Sure some => forall x, In x some -> met (of x) /\ meets_within r (of x) /\
      from_below (fewest x) (nearness (of x)) /\ from_above (most x) (nearness (of x))
  | Open x => met (of x) -> from_above (most x) (nearness (of x))
  | MakeRoom => True
  end.
Definition about (e : event) (s : surface) : Prop :=
  match e with
  | Sure some => In s (map of some)
  | Open x => of x = s
  | MakeRoom => False
  end.

Record sweep_facts : Prop := {
  (** Film.v: nothing that is met is left out; a wider bound, for many pixels at once *)
  swept_all : forall s, met s -> exists e, In e events /\ about e s;
  swept_right : forall e, In e events -> right_about e;
  (** the projection's nearness *)
  nearness_right : forall s s', met s -> met s' -> nearness s' < nearness s -> t r s < t r s'
}.
Hypothesis F : sweep_facts.

Lemma less_apart x y u v : less x y = true -> from_above x u -> from_below y v -> u < v.
Proof.
  destruct x as [|x|], y as [|y|]; simpl; try discriminate; try contradiction.
  case Rlt_bool_spec; intros; [lra | discriminate].
Qed.
Lemma less_trans x y z : less x y = true -> less y z = true -> less x z = true.
Proof.
  destruct x as [|x|], y as [|y|], z as [|z|]; simpl; auto; try discriminate.
  do 3 case Rlt_bool_spec; auto; intros; try discriminate; lra.
Qed.

Definition sound_winner (p : pixel) : Prop := forall w, winner p = Some w ->
  met (of w) /\ meets_within r (of w) /\
  from_below (fewest w) (nearness (of w)) /\ from_above (most w) (nearness (of w)).
Definition sound_rivals (p : pixel) : Prop := forall e, In e (rivals p) ->
  met (of e) -> from_above (most e) (nearness (of e)).

(** A surface that is met is the winner, or a rival, or below the nearness of the winner. *)
Definition hidden (p : pixel) (s : surface) : Prop :=
  exists m, from_above m (nearness s) /\ less m (nearness_of p) = true.
Definition accounted (p : pixel) (s : surface) : Prop :=
  (exists w, winner p = Some w /\ of w = s) \/ In s (map of (rivals p)) \/ hidden p s.

Lemma hidden_stays p q s : hidden p s ->
  nearness_of p = nearness_of q \/ less (nearness_of p) (nearness_of q) = true -> hidden q s.
Proof.
  intros [m [A L]] [E|B]; exists m; split; auto;
    [congruence | now apply (less_trans _ (nearness_of p))].
Qed.

Lemma filter_shorter {A} (f : A -> bool) l : (length (filter f l) <= length l)%nat.
Proof. induction l as [|x l IH]; simpl; auto. destruct (f x); simpl; lia. Qed.

Lemma not_other x e : In (of x) scene -> In (of e) scene -> other_than x e = false -> of x = of e.
Proof.
  intros I J O. apply (names_differ P); auto. unfold other_than in O.
  apply orb_false_iff in O. destruct O as [A B].
  assert (N : forall b, b = false -> ~ b = true) by (intros; congruence).
  apply N in A. apply N in B. rewrite before_spec in A, B.
  destruct (called (of x)) as [i k], (called (of e)) as [i' k']. simpl in *. f_equal; lia.
Qed.

Lemma write_right p some q again : write p some = (q, again) ->
  right_about (Sure some) -> sound_winner p -> sound_rivals p ->
  sound_winner q /\ sound_rivals q /\ incl again some /\
  (some <> [] -> (length again < length some)%nat) /\
  (forall s, met s -> accounted p s -> accounted q s) /\
  (forall x, In x some -> accounted q (of x) \/ In x again).
Proof.
  intros E R W V. unfold write in E. cbv zeta in E.
  set (n := nearness_of p) in *.
  set (nearer := filter (fun e => less n (fewest e)) some) in *.
  set (near := filter (fun e => negb (less n (fewest e) || less (most e) n)) some) in *.
  assert (In_nearer : forall x, In x nearer <-> In x some /\ less n (fewest x) = true)
    by (intros; apply filter_In).
  assert (Near : forall x, In x near -> In x some) by (intros x X; now apply filter_In in X).
  assert (Rest : forall x, In x some -> less n (fewest x) = false ->
    In x near \/ less (most x) n = true).
  { intros x X L. destruct (less (most x) n) eqn:M; auto. left. apply filter_In. now rewrite L, M. }
  destruct (rev nearer) as [|x others] eqn:Er; apply pair_equal_spec in E; destruct E as [<- <-].
  - assert (None : forall x, In x some -> less n (fewest x) = false).
    { intros x X. destruct (less n (fewest x)) eqn:L; auto.
      assert (K : In x (rev nearer)) by (rewrite <- in_rev; now apply In_nearer).
      rewrite Er in K. destruct K. }
    split; [exact W|]. split; [|split; [easy|split; [destruct some; simpl; [easy | lia] | split]]].
    + intros e He. simpl in He. apply in_app_or in He. destruct He as [He|He]; [now apply V|].
      intros _. now apply R, Near.
    + intros s _ [H|[H|H]]; [now left | | now right; right].
      right. left. simpl. rewrite map_app, in_app_iff. auto.
    + intros y Y. left. destruct (Rest y Y (None y Y)) as [K|K].
      * right. left. simpl. rewrite map_app, in_app_iff. right. now apply in_map.
      * right. right. exists (most y). split; auto. now apply R.
  - assert (Ix : In x nearer) by (rewrite in_rev, Er; simpl; auto).
    apply In_nearer in Ix. destruct Ix as [Ix Lx]. rewrite <- Er.
    set (beaten := match winner p with Some _ => _ | None => [] end).
    assert (Up : forall s, hidden p s -> hidden (Pixel (Some x) (rivals p ++ near ++ beaten)) s).
    { intros s H. apply (hidden_stays p); auto. }
    split; [|split; [|split; [|split; [|split]]]].
    + intros w Hw. inversion Hw; subst. now apply R.
    + intros e He. simpl in He. rewrite !in_app_iff in He.
      destruct He as [He|[He|He]]; [now apply V | |].
      * intros _. now apply R, Near.
      * intros _. unfold beaten in He. destruct (winner p) as [w|] eqn:Ew; [|destruct He].
        destruct (existsb _ _); [|destruct He]. destruct He as [He|[]]. subst. now apply W.
    + intros e He. apply filter_In in He. destruct He as [He _]. rewrite <- in_rev in He.
      now apply In_nearer.
    + intros _. apply Nat.lt_le_trans with (length nearer); [|apply filter_shorter].
      rewrite <- (rev_length nearer), Er. simpl.
      assert (S : other_than x x = false).
      { unfold other_than. destruct (before (of x) (of x)) eqn:B; auto.
        now apply before_differs in B. }
      rewrite S. apply Nat.lt_succ_r, filter_shorter.
    + intros s M [[w [Hw K]]|[H|H]]; [| |right; right; now apply Up].
      * subst s. destruct (existsb (fun e => negb (less (most w) (fewest e))) nearer) eqn:B.
        -- right. left. simpl. rewrite !map_app, !in_app_iff. right. right. unfold beaten.
           rewrite Hw, B. simpl; auto.
        -- right. right. exists (most w). split; [now apply W|]. simpl.
           destruct (less (most w) (fewest x)) eqn:L; auto. exfalso.
           assert (C : existsb (fun e => negb (less (most w) (fewest e))) nearer = true);
             [|congruence].
           apply existsb_exists. exists x. rewrite L. split; auto. now apply In_nearer.
      * right. left. simpl. rewrite map_app, in_app_iff. auto.
    + intros y Y. destruct (less n (fewest y)) eqn:L.
      * destruct (other_than x y) eqn:O.
        -- right. apply filter_In. split; auto. rewrite <- in_rev. now apply In_nearer.
        -- left. left. exists x. split; auto. apply not_other; auto; now apply R.
      * left. right. destruct (Rest y Y L) as [K|K].
        -- left. simpl. rewrite !map_app, !in_app_iff. right. left. now apply in_map.
        -- right. apply Up. exists (most y). split; auto. now apply R.
Qed.

Lemma enter_right n : forall p some, (length some <= n)%nat ->
  right_about (Sure some) -> sound_winner p -> sound_rivals p ->
  let q := enter_sure n p some in
  sound_winner q /\ sound_rivals q /\ (forall s, met s -> accounted p s -> accounted q s) /\
  (forall x, In x some -> accounted q (of x)).
Proof.
  induction n as [|n IH]; intros p some L R W V; destruct some as [|x some]; simpl in L |- *;
    try (split; [exact W|split; [exact V|split; [auto|easy]]]).
  destruct (write p (x :: some)) as [q again] eqn:E.
  destruct (write_right _ _ _ _ E R W V) as [W' [V' [I [S [A B]]]]].
  assert (S' := S ltac:(easy)). simpl in S'.
  destruct (IH q again) as [W2 [V2 [A2 B2]]]; auto; [lia | intros y Y; apply R, I, Y |].
  split; [exact W2|]. split; [exact V2|]. split; [auto|].
  intros y Y. destruct (B y Y) as [H|H]; auto. apply A2; auto. now apply R.
Qed.

Lemma happen_right p e : right_about e -> sound_winner p -> sound_rivals p ->
  let q := happen p e in
  sound_winner q /\ sound_rivals q /\ (forall s, met s -> accounted p s -> accounted q s) /\
  (forall s, met s -> about e s -> accounted q s).
Proof.
  intros R W V. destruct e as [some|x|]; simpl.
  - destruct (enter_right (length some) p some) as [W' [V' [A B]]]; auto.
    split; [exact W'|]. split; [exact V'|]. split; [exact A|].
    intros s _ H. apply in_map_iff in H. destruct H as [x [E X]]. subst. auto.
  - destruct (less (most x) (nearness_of p)) eqn:L.
    + split; [exact W|]. split; [exact V|]. split; auto. intros s M E. subst.
      right. right. exists (most x). auto.
    + split; [exact W|]. split; [|split].
      * intros e He. simpl in He. apply in_app_or in He.
        destruct He as [He|[He|[]]]; [now apply V|].
        now subst.
      * intros s _ [H|[H|H]]; [now left | | now right; right].
        right. left. simpl. rewrite map_app, in_app_iff. auto.
      * intros s _ E. right. left. simpl. rewrite map_app, in_app_iff. subst. simpl. auto.
  - split; [exact W|]. split; [|split; [|easy]].
    + intros e He. apply filter_In in He. now apply V.
    + intros s M [H|[H|H]]; [now left | | now right; right].
      apply in_map_iff in H. destruct H as [e [E He]]. subst.
      destruct (less (most e) (nearness_of p)) eqn:L.
      * right. right. exists (most e). split; auto; now apply V.
      * right. left. apply in_map. apply filter_In. now rewrite L.
Qed.

Lemma swept_is_right : let p := swept events in
  sound_winner p /\ sound_rivals p /\ forall s, met s -> accounted p s.
Proof.
  assert (G : forall some p, (forall e, In e some -> right_about e) ->
    sound_winner p -> sound_rivals p -> let q := fold_left happen some p in
    sound_winner q /\ sound_rivals q /\ (forall s, met s -> accounted p s -> accounted q s) /\
    (forall s e, met s -> In e some -> about e s -> accounted q s)).
  { induction some as [|e some IH]; intros p R W V; simpl.
    - split; [exact W|]. split; [exact V|]. split; auto. easy.
    - destruct (happen_right p e) as [W' [V' [A B]]]; auto; [apply R; simpl; auto|].
      destruct (IH (happen p e)) as [W2 [V2 [A2 B2]]]; auto; [intros; apply R; simpl; auto|].
      split; [exact W2|]. split; [exact V2|]. split; auto.
      intros s e' M [H|H] K; [subst; auto | now apply (B2 s e')]. }
  destruct (G events empty) as [W [V [_ B]]]; [apply (swept_right F) | easy | easy |].
  split; [exact W|]. split; [exact V|]. intros s M.
  destruct (swept_all F s M) as [e [I K]]. now apply (B s e).
Qed.

(** At the end: the winner is met, and all that is met is handed over or behind the winner. *)
Lemma at_the_end : let p := swept events in
  (forall w, winner p = Some w -> met (of w) /\ meets_within r (of w)) /\
  (forall s, met s -> In s (handed_over p) \/
    exists w, winner p = Some w /\ t r (of w) < t r s).
Proof.
  destruct swept_is_right as [W [V A]]. set (p := swept events) in *. simpl. split.
  - intros w E. destruct (W w E) as [M [K _]]. auto.
  - intros s M.
    assert (Hidden : hidden p s -> exists w, winner p = Some w /\ t r (of w) < t r s).
    { intros [m [B L]]. unfold nearness_of in L. destruct (winner p) as [w|] eqn:E.
      - exists w. split; auto. destruct (W w E) as [Mw [_ [C _]]].
        apply (nearness_right F); auto. now apply (less_apart m (fewest w)).
      - destruct m; discriminate. }
    unfold handed_over. destruct (A s M) as [[w [E K]]|[H|H]]; [| |right; auto].
    + left. rewrite E. apply in_or_app. left. simpl. auto.
    + apply in_map_iff in H. destruct H as [e [E He]]. subst s.
      destruct (less (most e) (nearness_of p)) eqn:L.
      * right. apply Hidden. exists (most e). split; auto; now apply V.
      * left. apply in_or_app. right. apply in_map. apply filter_In. now rewrite L.
Qed.

(** The contest of a pixel that is open sees at least what is handed over, which is of the scene. *)
Theorem sweep_sees_what_plain_does handed batches' a' :
  incl (handed_over (swept events)) handed -> incl handed scene ->
  facts r moved start end_ handed batches' a' ->
  let answer := verdict events (plain a' start end_ batches') in
  let definition := plain a start end_ batches in
  fst answer = owner definition /\ (snd answer = AMBIGUOUS <-> certain definition = AMBIGUOUS).
Proof.
  intros I J Q answer definition. destruct at_the_end as [W A].
  destruct (plain_is_right _ _ _ _ _ _ _ P) as [O [C _]]. fold definition in O, C.
  destruct (plain_is_right _ _ _ _ _ _ _ Q) as [O' [C' _]].
  assert (Same : forall o c, moved_sees r moved start end_ scene o ->
    match c with
    | BOUND | EXACT => clearly_sees r start end_ scene o
    | AMBIGUOUS => forall o, ~ clearly_sees r start end_ scene o
    end -> o = owner definition /\ (c = AMBIGUOUS <-> certain definition = AMBIGUOUS)).
  { intros o c M K. split; [now apply (moved_unique P)|].
    destruct c, (certain definition); split; intros E; try discriminate; auto;
      exfalso; eapply C || eapply K; eassumption. }
  assert (Down : forall s, met s -> In s handed -> Facts.met r start end_ handed s)
    by (intros s [_ M] H; now split).
  assert (Up : forall s, Facts.met r start end_ handed s -> met s)
    by (intros s [H M]; split; auto).
  assert (B : forall s, met s -> In s handed \/ exists w, In w handed /\ met w /\
    meets_within r w /\ t r w < t r s).
  { intros s M. destruct (A s M) as [H|[w [E L]]]; auto. right. exists (of w).
    destruct (W w E). repeat split; auto; try apply H. apply I. unfold handed_over.
    rewrite E. simpl. auto. }
  assert (Clear : forall o,
    clearly_sees r start end_ handed o <-> clearly_sees r start end_ scene o).
  { intros [s|]; simpl; split.
    - intros [M [K N]]. split; [auto|]. split; auto. intros s' M' D.
      destruct (B s' M') as [H|[w [H [Mw [_ L]]]]]; auto.
      destruct (same_or_not P w s) as [E|E]; [apply J, H | apply J, M | now subst |].
      specialize (N w (Down w Mw H) E). lra.
    - intros [M [K N]]. assert (H : In s handed).
      { destruct (B s M) as [H|[w [H [Mw [_ L]]]]]; auto. exfalso.
        destruct (same_or_not P w s) as [E|E]; [apply J, H | apply M | subst; lra |].
        specialize (N w Mw E). lra. }
      split; auto.
    - intros N s M. destruct (B s M) as [H|[w [H [Mw _]]]]; [apply (N s) | apply (N w)]; auto.
    - intros N s M. apply (N s). auto. }
  unfold answer, verdict. destruct (not_hidden (swept events)) as [|e rest] eqn:E; simpl.
  - assert (K : clearly_sees r start end_ scene (option_map of (winner (swept events)))).
    { unfold handed_over in A. rewrite E in A.
      destruct (winner (swept events)) as [w|]; simpl in A |- *.
      - destruct (W w eq_refl) as [M V]. split; auto. split; auto. intros s M' D.
        destruct (A s M') as [[H|[]]|[w' [H L]]]; [congruence|]. now inversion H; subst.
      - intros s M. destruct (A s M) as [[]|[w [H _]]]. discriminate. }
    apply Same; auto. now apply (clear_moved P).
  - apply Same.
    + assert (V : forall s, moved_meets r moved start end_ scene s -> In s handed ->
        moved_meets r moved start end_ handed s) by (intros s [_ M] H; now split).
      assert (Behind : forall s, moved_meets r moved start end_ scene s -> In s handed \/
        exists w, moved_meets r moved start end_ handed w /\ t moved w < t moved s).
      { intros s M. assert (Ms := moved_meets_met P s M).
        destruct (B s Ms) as [H|[w [H [Mw [K L]]]]]; auto. right. exists w.
        assert (Vw := moved_stays_inside P w Mw K). split.
        - split; [exact H|]. split; [exact Vw|]. split; [now apply (within_D r)|apply Mw].
        - apply (moved_keeps_order P); auto. apply M. }
      destruct (owner (plain a' start end_ batches')) as [s|]; simpl in O' |- *.
      * destruct O' as [M N]. split; [destruct M as [H M]; split; auto|].
        intros s' M' D. destruct (Behind s' M') as [H|[w [Mw L]]]; auto. left.
        destruct (same_or_not P w s) as [F'|F']; [apply J, Mw | apply J, M | now subst |].
        destruct (N w Mw F') as [N'|[N' _]]; [lra|].
        rewrite (same_plane_t moved _ _ N'); auto. apply within_D, Mw.
      * intros s M.
        destruct (Behind s M) as [H|[w [Mw _]]]; [now apply (O' s), V | now apply (O' w)].
    + destruct (certain (plain a' start end_ batches')); try (now apply Clear).
      intros o K. apply (C' o). now apply Clear.
Qed.

End Sweep.

