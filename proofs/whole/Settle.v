(** What integers say of those who are left: who is the nearest, and whether that is clear. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Contest Facts Nearest.
Import ListNotations.
Open Scope R_scope.

Section Settle.
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

(** ** By integers *)

Local Notation hits := (filter (hit a) those).

Lemma hits_are s : In s hits <-> In s those /\ met s.
Proof.
  rewrite filter_In. split; intros [H I]; split; auto; now apply (hit_right F _ (those_some F _ H)).
Qed.
Lemma hit_or_behind s : met s ->
  In s hits \/ exists w, In w hits /\ meets_within r w /\ t r w < t r s.
Proof.
  intros M. destruct (met_or_behind F s M) as [H|[w [H [S L]]]].
  - left. now apply hits_are.
  - right. exists w. destruct (sure_is_met F w (those_some F _ H) S) as [Mw [W _]].
    repeat split; auto. now apply hits_are.
Qed.

(** [first] is the nearest of all that the moved ray hits. *)
Definition beats (s s' : surface) : Prop :=
  t moved s < t moved s' \/ (same_plane s s' /\ before s s' = true).
Lemma beats_trans s s' s'' : D moved s' <> 0 -> D moved s'' <> 0 ->
  beats s s' -> beats s' s'' -> beats s s''.
Proof.
  unfold beats. intros N N' [H|[H B]] [H'|[H' B']].
  - left. lra.
  - left. rewrite <- (same_plane_t _ _ _ H' N'). auto.
  - left. rewrite (same_plane_t _ _ _ H N). auto.
  - right. split; [now apply (same_plane_trans _ s') | now apply (before_trans _ s')].
Qed.

Definition first_of (l : list surface) (o : option surface) : Prop :=
  match o with
  | None => forall s, In s l -> is_crossed a s = false
  | Some s => In s l /\ is_crossed a s = true /\
      forall s', In s' l -> is_crossed a s' = true -> s' <> s -> beats s s'
  end.
Lemma first_right l : (forall s, In s l -> met s) -> first_of l (first a l).
Proof.
  intros M. unfold first.
  assert (G : forall rest done best, (forall s, In s (done ++ rest) -> met s) ->
    first_of done best -> first_of (done ++ rest) (fold_left (nearer_of a) rest best)).
  { clear l M.
    induction rest as [|s rest IH]; intros done best M B; simpl; [now rewrite app_nil_r|].
    replace (done ++ s :: rest) with ((done ++ [s]) ++ rest) in * by now rewrite <- app_assoc.
    apply IH; auto. assert (Ms : met s) by (apply M, in_or_app; left; apply in_or_app; simpl; auto).
    assert (Md : forall x, In x done -> met x)
      by (intros; apply M, in_or_app; left; apply in_or_app; auto).
    unfold nearer_of. destruct (is_crossed a s) eqn:Hs.
    - destruct best as [b|]; simpl in B.
      + destruct B as [Ib [Hb B]]. assert (Mb := Md _ Ib).
        assert (Vs := proj1 (is_crossed_right F _ Ms) Hs).
        assert (Vb := proj1 (is_crossed_right F _ Mb) Hb).
        assert (S := sign_right F s b Ms Mb Vs Vb).
        assert (Stay : beats b s -> first_of (done ++ [s]) (Some b)).
        { intros Q. split; [apply in_or_app; auto|]. split; auto.
          intros s' I H N. apply in_app_or in I. destruct I as [I|[I|[]]]; subst; auto. }
        assert (Same : s = b -> first_of (done ++ [s]) (Some b)).
        { intros Q. subst. split; [apply in_or_app; auto|]. split; auto.
          intros s' I H N. apply in_app_or in I.
          destruct I as [I|[I|[]]]; subst; auto; now destruct N. }
        assert (Change : beats s b -> first_of (done ++ [s]) (Some s)).
        { intros Q. split; [apply in_or_app; simpl; auto|]. split; auto.
          intros s' I H N. apply in_app_or in I. destruct I as [I|[I|[]]]; [|now destruct N].
          destruct (same_or_not F s' b) as [E|E];
            [apply met_in; auto | apply met_in; auto | now subst |].
          assert (V' := proj1 (is_crossed_right F _ (Md _ I)) H).
          apply (beats_trans s b s'); auto using within_D. }
        destruct (sign_of_difference a s b).
        * destruct (before s b) eqn:N; [apply Change; right; auto|].
          destruct (same_or_not F s b) as [E|E]; [now apply met_in | now apply met_in | auto |].
          apply Stay. right. split; [now apply same_plane_sym|].
          destruct (before_total F s b) as [Q|Q]; auto using met_in. congruence.
        * apply Change. now left.
        * apply Stay. now left.
      + split; [apply in_or_app; simpl; auto|]. split; auto.
        intros s' I H N. apply in_app_or in I. destruct I as [I|[I|[]]]; [|now destruct N].
        rewrite (B _ I) in H. discriminate.
    - destruct best as [b|]; simpl in *.
      + destruct B as [Ib [Hb B]]. split; [apply in_or_app; auto|]. split; auto.
        intros s' I H N. apply in_app_or in I. destruct I as [I|[I|[]]]; auto. congruence.
      + intros s' I. apply in_app_or in I. destruct I as [I|[I|[]]]; auto. congruence. }
  apply (G l [] None); simpl; auto. easy.
Qed.

Lemma first_moved : moved_sees (first a hits).
Proof.
  assert (M : forall s, In s hits -> met s) by (intros s H; now apply hits_are).
  generalize (first_right hits M). destruct (first a hits) as [s|]; simpl.
  - intros [I [H B]]. assert (Ms := M _ I). assert (V := proj1 (is_crossed_right F _ Ms) H). split.
    + destruct Ms as [J [C R]]. repeat split; auto; try apply R. now apply closed_D.
    + intros s' M' N. assert (E := moved_meets_met F _ M'). destruct M' as [J [V' _]].
      destruct (hit_or_behind s' E) as [I'|[w [I' [W L]]]].
      * apply B; auto. now apply (is_crossed_right F).
      * assert (Mw := M _ I'). assert (Vw := moved_stays_inside F _ Mw W).
        assert (L' := moved_keeps_order F _ _ Mw E Vw V' L). left.
        destruct (same_or_not F w s) as [Q|Q]; auto using met_in; [now subst|].
        destruct (B w I' (proj2 (is_crossed_right F _ Mw) Vw) Q) as [K|[K _]]; [lra|].
        rewrite (same_plane_t moved _ _ K (within_D _ _ Vw)). auto.
  - intros B s M'. assert (E := moved_meets_met F _ M'). destruct M' as [J [V' _]].
    destruct (hit_or_behind s E) as [I'|[w [I' [W L]]]].
    + specialize (B _ I'). rewrite (proj2 (is_crossed_right F _ E) V') in B. discriminate.
    + assert (Mw := M _ I'). specialize (B _ I').
      rewrite (proj2 (is_crossed_right F _ Mw) (moved_stays_inside F _ Mw W)) in B. discriminate.
Qed.

(** No ties: a clear answer; ties: none. *)
Definition least_of (l : list surface) (o : option surface) : Prop :=
  match o with None => l = [] | Some s => In s l /\ forall s', In s' l -> t r s <= t r s' end.
Lemma least_by_gap_right l : (forall s, In s l -> met s) -> least_of l (least_by_gap a l).
Proof.
  intros M. unfold least_by_gap. destruct l as [|x l]; simpl; auto.
  set (f := fun (best : option surface) s => _).
  assert (G : forall rest done b, (forall s, In s (done ++ rest) -> met s) ->
    least_of done (Some b) ->
    least_of (done ++ rest) (fold_left f rest (Some b))).
  { clear l M.
    induction rest as [|s rest IH]; intros done b M B; simpl fold_left; [now rewrite app_nil_r|].
    replace (done ++ s :: rest) with ((done ++ [s]) ++ rest) in * by now rewrite <- app_assoc.
    destruct B as [Ib B].
    assert (Ms : met s) by (apply M, in_or_app; left; apply in_or_app; simpl; auto).
    assert (Mb : met b) by (apply M, in_or_app; left; apply in_or_app; auto).
    rewrite (gap_right F _ _ Ms Mb).
    case Rcompare_spec; intros C; apply IH; auto; (split; [apply in_or_app; simpl; auto|]);
      intros s' I; apply in_app_or in I; destruct I as [I|[I|[]]]; subst; try lra;
      specialize (B _ I); lra. }
  apply (G l [x] x); simpl; auto. split; simpl; auto. intros s' [I|[]]. subst. lra.
Qed.

Lemma only_one (l : list surface) s : NoDup l -> In s l -> (forall x, In x l -> x = s) -> l = [s].
Proof.
  intros N I A. destruct l as [|x [|y l]]; [destruct I | |].
  - f_equal. apply A. simpl; auto.
  - inversion N; subst. exfalso. apply H1. rewrite (A x), <- (A y); simpl; auto.
Qed.

Lemma ties_right : if no_ties a hits then clearly_sees (first a hits)
  else forall o, ~ clearly_sees o.
Proof.
  assert (M : forall s, In s hits -> met s) by (intros s H; now apply hits_are).
  assert (N : NoDup hits) by apply NoDup_filter, (those_once F).
  set (inside := filter (fun s => negb (on_edge a s)) hits).
  assert (In_inside : forall s, In s inside <-> In s hits /\ meets_within r s).
  { intros s. unfold inside. rewrite filter_In, negb_true_iff.
    split; intros [A B]; split; auto; now apply (on_edge_right F _ (M _ A)). }
  assert (L : least_of inside (least_by_gap a inside)).
  { apply least_by_gap_right. intros s H. apply M. now apply In_inside. }
  destruct (no_ties a hits) eqn:E.
  - assert (C : exists o, clearly_sees o).
    { revert E. unfold no_ties, front. fold inside.
      destruct (least_by_gap a inside) as [l|]; simpl in L.
      - destruct L as [Il L].
        set (front := filter _ hits).
        assert (If : In l front).
        { apply filter_In. apply In_inside in Il. destruct Il as [Il W]. split; auto.
          rewrite (gap_right F _ _ (M _ Il) (M _ Il)), Rcompare_Eq; auto. }
        destruct front as [|s [|]] eqn:Ef; try discriminate; [destruct If|]. intros _.
        destruct If as [If|[]]. subst s. exists (Some l). apply In_inside in Il.
        destruct Il as [Il W]. assert (Ml := M _ Il). split; [exact Ml|]. split; [exact W|].
        intros s' M' Q.
        assert (B : forall x, In x hits -> x <> l -> t r l < t r x).
        { intros x I K. assert (Mx := M _ I).
          destruct (Rlt_or_le (t r l) (t r x)) as [|K']; auto. exfalso.
          assert (J : In x front).
          { apply filter_In. split; auto. rewrite (gap_right F _ _ Mx Ml).
            case Rcompare_spec; auto; lra. }
          rewrite Ef in J. destruct J as [J|[]]. congruence. }
        destruct (hit_or_behind s' M') as [I|[w [I [_ K]]]]; [now apply B|].
        destruct (same_or_not F w l) as [J|J]; auto using met_in; [now subst|].
        specialize (B _ I J). lra.
      - intros E. exists None. intros s Ms.
        assert (K : hits = []).
        { assert (Eh : exists h, hits = h) by eauto. destruct Eh as [h Eh]. rewrite Eh in E |- *.
          destruct h as [|x [|]]; auto; try discriminate. exfalso.
          apply negb_true_iff in E.
          assert (I : In x hits) by (rewrite Eh; simpl; auto).
          assert (J : In x inside)
            by (apply In_inside; split; auto; now apply (on_edge_right F _ (M _ I))).
          rewrite L in J. destruct J. }
        destruct (hit_or_behind s Ms) as [I|[w [I _]]]; rewrite K in I; destruct I. }
    destruct C as [o C]. now rewrite (moved_unique F _ _ first_moved (clear_moved F _ C)).
  - intros o C. assert (E' : no_ties a hits = true); [|congruence]. clear E. unfold no_ties, front.
    fold inside. destruct o as [s|]; simpl in C.
    + destruct C as [Ms [W A]].
      assert (I : In s hits).
      { destruct (hit_or_behind s Ms) as [|[w [I [_ K]]]]; auto. exfalso.
        destruct (same_or_not F w s) as [J|J]; auto using met_in; [subst; lra|].
        specialize (A _ (M _ I) J). lra. }
      assert (Is : In s inside) by now apply In_inside.
      destruct (least_by_gap a inside) as [l|]; simpl in L; [|rewrite L in Is; destruct Is].
      destruct L as [Il L]. assert (Ml : met l) by (apply M; now apply In_inside).
      assert (l = s).
      { destruct (same_or_not F l s) as [J|J]; auto using met_in. specialize (A _ Ml J).
        specialize (L _ Is). lra. }
      subst l. rewrite (only_one (filter _ hits) s).
      * apply negb_true_iff. now apply (on_edge_right F).
      * now apply NoDup_filter.
      * apply filter_In. split; auto. now rewrite (gap_right F _ _ Ms Ms), Rcompare_Eq.
      * intros x X. apply filter_In in X. destruct X as [X G].
        destruct (same_or_not F x s) as [J|J]; auto using met_in.
        rewrite (gap_right F _ _ (M _ X) Ms), Rcompare_Gt in G; [discriminate | auto].
    + assert (K : hits = []).
      { assert (Eh : exists h, hits = h) by eauto. destruct Eh as [h Eh]. rewrite Eh.
        destruct h as [|x]; auto. exfalso. apply (C x). apply M. rewrite Eh. simpl; auto. }
      unfold inside. rewrite K. reflexivity.
Qed.

End Settle.
