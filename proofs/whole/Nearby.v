(** What holds of the ray that is moved infinitesimally holds of real rays, near the stored one.

    [plain_is_right] speaks of one moved ray. Here it becomes all that are near enough: what is
    [eventually] so is so for all moves that are small enough. Any notion with the properties of a
    [filter] will do; [soon] is the one for a direction that is moved by x, and an origin by a y
    that is much smaller. *)
Require Import ZArith Reals Psatz List Bool Classical.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Contest Facts Nearest Whole.
Import ListNotations.
Open Scope R_scope.

Record filter {A} (eventually : (A -> Prop) -> Prop) : Prop := {
  always : forall P : A -> Prop, (forall x, P x) -> eventually P;
  both : forall P Q, eventually P -> eventually Q -> eventually (fun x => P x /\ Q x);
  weaker : forall P Q : A -> Prop, (forall x, P x -> Q x) -> eventually P -> eventually Q;
  somewhere : forall P, eventually P -> exists x, P x
}.

(** For all x > 0 that are small enough, and then all y > 0 that are. *)
Definition small (P : R -> Prop) : Prop := exists e, 0 < e /\ forall x, 0 < x < e -> P x.
Definition soon (P : R * R -> Prop) : Prop := small (fun x => small (fun y => P (x, y))).

Lemma small_filter : filter small.
Proof.
  split.
  - intros P H. exists 1. split; [lra | auto].
  - intros P Q [e [E H]] [f [E' H']]. exists (Rmin e f).
    assert (M := Rmin_l e f). assert (M' := Rmin_r e f).
    split; [now apply Rmin_glb_lt|]. intros x X. split; [apply H | apply H']; lra.
  - intros P Q W [e [E H]]. exists e. split; auto.
  - intros P [e [E H]]. exists (e / 2). apply H. lra.
Qed.
Lemma soon_filter : filter soon.
Proof.
  assert (F := small_filter). split; unfold soon.
  - intros P H. apply (always _ F). intros x. apply (always _ F). auto.
  - intros P Q H H'.
    apply (weaker _ F (fun x => small (fun y => P (x, y)) /\ small (fun y => Q (x, y)))).
    + intros x [A B]. now apply (both _ F (fun y => P (x, y)) (fun y => Q (x, y))).
    + now apply (both _ F).
  - intros P Q W. apply (weaker _ F). intros x. apply (weaker _ F). auto.
  - intros P H. destruct (somewhere _ F _ H) as [x H']. destruct (somewhere _ F _ H') as [y K].
    now exists (x, y).
Qed.

Section Nearby.
Context {A : Type} {eventually : (A -> Prop) -> Prop} (E : filter eventually).

Lemma for_all {B} (l : list B) (P : B -> A -> Prop) : (forall b, In b l -> eventually (P b)) ->
  eventually (fun x => forall b, In b l -> P b x).
Proof.
  induction l as [|b l IH]; intros H.
  - apply (always _ E). easy.
  - apply (weaker _ E (fun x => P b x /\ forall c, In c l -> P c x)).
    + intros x [K L] c [C|C]; [now subst | auto].
    + apply (both _ E); [apply H; simpl; auto | apply IH; intros; apply H; simpl; auto].
Qed.
Lemma given (Q : Prop) (P : A -> Prop) : (Q -> eventually P) -> eventually (fun x => Q -> P x).
Proof.
  intros H. destruct (classic Q) as [K|K].
  - apply (weaker _ E P); auto.
  - apply (always _ E). easy.
Qed.

(** ** Limits *)

Definition tends (f : A -> R) (l : R) : Prop :=
  forall e, 0 < e -> eventually (fun x => Rabs (f x - l) < e).

Lemma tends_const c : tends (fun _ => c) c.
Proof. intros e H. apply (always _ E). intros _. now rewrite Rminus_diag_eq, Rabs_R0. Qed.
Lemma tends_plus f g l m : tends f l -> tends g m -> tends (fun x => f x + g x) (l + m).
Proof.
  intros F G e H. assert (H2 : 0 < e / 2) by lra.
  refine (weaker _ E _ _ _ (both _ E _ _ (F _ H2) (G _ H2))). intros x [K L].
  apply Rabs_def2 in K. apply Rabs_def2 in L. apply Rabs_def1; lra.
Qed.
Lemma tends_opp f l : tends f l -> tends (fun x => - f x) (- l).
Proof.
  intros F e H. refine (weaker _ E _ _ _ (F _ H)). intros x K.
  apply Rabs_def2 in K. apply Rabs_def1; lra.
Qed.
Lemma tends_minus f g l m : tends f l -> tends g m -> tends (fun x => f x - g x) (l - m).
Proof. intros F G. apply tends_plus; auto. now apply tends_opp. Qed.
Lemma tends_mult f g l m : tends f l -> tends g m -> tends (fun x => f x * g x) (l * m).
Proof.
  intros F G e H. assert (P := Rabs_pos l). assert (Q := Rabs_pos m).
  set (k := Rabs l + Rabs m + 1). set (d := Rmin 1 (e / k)).
  assert (D : 0 < d) by (apply Rmin_glb_lt; [lra | apply Rdiv_lt_0_compat; unfold k; lra]).
  assert (D1 : d <= 1) by apply Rmin_l.
  assert (Dk : d * k <= e).
  { apply Rle_trans with (e / k * k); [apply Rmult_le_compat_r; [unfold k; lra | apply Rmin_r]|].
    right. field. unfold k. lra. }
  refine (weaker _ E _ _ _ (both _ E _ _ (F _ D) (G _ D))). intros x [K L].
  replace (f x * g x - l * m) with ((f x - l) * (g x - m) + (f x - l) * m + l * (g x - m)) by ring.
  eapply Rle_lt_trans; [apply Rabs_triang|]. eapply Rle_lt_trans.
  { apply Rplus_le_compat_r, Rabs_triang. }
  rewrite !Rabs_mult. unfold k in Dk.
  assert (P1 := Rabs_pos (f x - l)). assert (P2 := Rabs_pos (g x - m)). nra.
Qed.
Lemma tends_less f g l m : tends f l -> tends g m -> l < m -> eventually (fun x => f x < g x).
Proof.
  intros F G H. assert (D : 0 < (m - l) / 2) by lra.
  refine (weaker _ E _ _ _ (both _ E _ _ (F _ D) (G _ D))). intros x [K L].
  apply Rabs_def2 in K. apply Rabs_def2 in L. lra.
Qed.
Lemma tends_negative f l : tends f l -> l < 0 -> eventually (fun x => f x < 0).
Proof. intros F H. apply (tends_less f (fun _ => 0) l 0); auto using tends_const. Qed.
Lemma tends_positive f l : tends f l -> 0 < l -> eventually (fun x => 0 < f x).
Proof. intros F H. apply (tends_less (fun _ => 0) f 0 l); auto using tends_const. Qed.

(** ** A ray that comes near the stored one *)

Variables (path : A -> ray) (r : ray).
Definition comes_near : Prop :=
  (tends (fun x => vx (origin (path x))) (vx (origin r)) /\
   tends (fun x => vy (origin (path x))) (vy (origin r)) /\
   tends (fun x => vz (origin (path x))) (vz (origin r))) /\
  (tends (fun x => vx (direction (path x))) (vx (direction r)) /\
   tends (fun x => vy (direction (path x))) (vy (direction r)) /\
   tends (fun x => vz (direction (path x))) (vz (direction r))).
Hypothesis Near : comes_near.

Ltac limit := destruct Near as [[Ox [Oy Oz]] [Dx [Dy Dz]]]; unfold dot, cross, vsub; simpl;
  repeat (apply tends_plus || apply tends_opp || apply tends_mult || assumption ||
          apply tends_const).

Lemma edge_near p q : tends (fun x => edge (path x) p q) (edge r p q).
Proof. unfold edge. limit. Qed.
Lemma T_near s : tends (fun x => T (path x) s) (T r s).
Proof. unfold T, numerator. destruct (shape_of s); limit. Qed.
Lemma D_near s : tends (fun x => D (path x) s) (D r s).
Proof. unfold D, denominator. destruct (shape_of s); limit. Qed.

Lemma D_stays s : D r s <> 0 -> eventually (fun x => 0 < D r s * D (path x) s).
Proof.
  intros N. apply (tends_positive _ (D r s * D r s)); [|nra].
  apply tends_mult; [apply tends_const | apply D_near].
Qed.

Lemma stays_inside s : meets_within r s -> eventually (fun x => meets_within (path x) s).
Proof.
  intros H. destruct (shape_of s) as [c|] eqn:S; unfold meets_within in *; rewrite S in *.
  - assert (N1 := edge_near (ca c) (cb c)). assert (N2 := edge_near (cb c) (cc c)).
    assert (N3 := edge_near (cc c) (ca c)).
    destruct H as [[H1 [H2 H3]]|[H1 [H2 H3]]].
    + refine (weaker _ E _ _ _ (both _ E _ _ (tends_positive _ _ N1 H1)
        (both _ E _ _ (tends_positive _ _ N2 H2) (tends_positive _ _ N3 H3)))).
      intros x K. left. exact K.
    + refine (weaker _ E _ _ _ (both _ E _ _ (tends_negative _ _ N1 H1)
        (both _ E _ _ (tends_negative _ _ N2 H2) (tends_negative _ _ N3 H3)))).
      intros x K. right. exact K.
  - refine (weaker _ E _ _ _ (D_stays s H)). intros x K N. rewrite N in K. lra.
Qed.

(** t1 < t2 is a matter of the sign of T1 D2 - T2 D1, times that of D1 D2. *)
Lemma t_less q s s' : D q s <> 0 -> D q s' <> 0 ->
  (t q s < t q s' <-> 0 < (T q s' * D q s - T q s * D q s') * (D q s * D q s')).
Proof.
  intros N N'. unfold t.
  assert (Q : D q s * D q s' <> 0) by now apply Rmult_integral_contrapositive.
  assert (P : 0 < (D q s * D q s') * (D q s * D q s')) by now apply Rsqr_pos_lt.
  assert (K : T q s' / D q s' - T q s / D q s =
    (T q s' * D q s - T q s * D q s') * (D q s * D q s') / ((D q s * D q s') * (D q s * D q s')))
    by now field.
  split; intros H.
  - apply (Rmult_lt_reg_r (/ ((D q s * D q s') * (D q s * D q s')))); [now apply Rinv_0_lt_compat|].
    rewrite Rmult_0_l. change (0 < (T q s' * D q s - T q s * D q s') * (D q s * D q s')
      / (D q s * D q s' * (D q s * D q s'))). rewrite <- K. lra.
  - assert (0 < T q s' / D q s' - T q s / D q s); [|lra]. rewrite K.
    now apply Rdiv_lt_0_compat.
Qed.

Lemma keeps_order s s' : D r s <> 0 -> D r s' <> 0 -> t r s < t r s' ->
  eventually (fun x => meets_within (path x) s -> meets_within (path x) s' ->
    t (path x) s < t (path x) s').
Proof.
  intros N N' L. apply t_less in L; auto.
  assert (G : eventually (fun x => 0 < (T (path x) s' * D (path x) s - T (path x) s * D (path x) s')
    * (D (path x) s * D (path x) s'))).
  { eapply tends_positive; [|exact L].
    repeat (apply tends_mult || apply tends_minus || apply T_near || apply D_near). }
  refine (weaker _ E _ _ _ G). intros x K V V'. apply t_less; auto; now apply within_D.
Qed.

(** Signs that are mixed stay so. *)
Lemma stay_mixed c : let e1 := edge r (ca c) (cb c) in let e2 := edge r (cb c) (cc c) in
  let e3 := edge r (cc c) (ca c) in
  (e1 < 0 \/ e2 < 0 \/ e3 < 0) -> (0 < e1 \/ 0 < e2 \/ 0 < e3) ->
  eventually (fun x => ~ meets_inside (path x) c).
Proof.
  intros e1 e2 e3 M M'.
  assert (N1 := edge_near (ca c) (cb c)). assert (N2 := edge_near (cb c) (cc c)).
  assert (N3 := edge_near (cc c) (ca c)). fold e1 in N1. fold e2 in N2. fold e3 in N3.
  assert (L : eventually (fun x => edge (path x) (ca c) (cb c) < 0 \/
    edge (path x) (cb c) (cc c) < 0 \/ edge (path x) (cc c) (ca c) < 0)).
  { destruct M as [K|[K|K]]; [refine (weaker _ E _ _ _ (tends_negative _ _ N1 K)) |
      refine (weaker _ E _ _ _ (tends_negative _ _ N2 K)) |
      refine (weaker _ E _ _ _ (tends_negative _ _ N3 K))]; auto. }
  assert (G : eventually (fun x => 0 < edge (path x) (ca c) (cb c) \/
    0 < edge (path x) (cb c) (cc c) \/ 0 < edge (path x) (cc c) (ca c))).
  { destruct M' as [K|[K|K]]; [refine (weaker _ E _ _ _ (tends_positive _ _ N1 K)) |
      refine (weaker _ E _ _ _ (tends_positive _ _ N2 K)) |
      refine (weaker _ E _ _ _ (tends_positive _ _ N3 K))]; auto. }
  refine (weaker _ E _ _ _ (both _ E _ _ L G)). intros x [K K'] V. unfold meets_inside in V. lra.
Qed.

Lemma meets_no_more s : D r s <> 0 ->
  eventually (fun x => meets_within (path x) s -> meets_closed r s).
Proof.
  intros N. destruct (classic (meets_closed r s)) as [C|C]; [apply (always _ E); auto|].
  unfold meets_within, meets_closed, D in *. destruct (shape_of s) as [c|]; [|easy].
  refine (weaker _ E _ _ _ (stay_mixed c _ _)); [easy | |]; unfold meets in C;
    apply NNPP; intros K; apply C; split; auto; [left | right]; lra.
Qed.

(** What the stored ray is parallel to, the moved one passes by, unless it begins in its plane. *)
Lemma parallel_is_missed s c : shape_of s = Triangular c -> direction r <> V 0 0 0 ->
  D r s = 0 -> T r s <> 0 -> eventually (fun x => ~ meets_within (path x) s).
Proof.
  intros S N P Q. unfold meets_within, D, T in *. rewrite S in *. rewrite denominator_sum in P.
  set (e1 := edge r (ca c) (cb c)) in *. set (e2 := edge r (cb c) (cc c)) in *.
  set (e3 := edge r (cc c) (ca c)) in *.
  assert (M : (e1 < 0 \/ e2 < 0 \/ e3 < 0) /\ (0 < e1 \/ 0 < e2 \/ 0 < e3)).
  { assert (K : ~ (e1 = 0 /\ e2 = 0 /\ e3 = 0)).
    { intros [K1 [K2 K3]]. apply N. unfold e1, e2, e3 in *. rewrite edge_other in K1, K2, K3.
      destruct r as [[ox oy oz] [dx dy dz]], c as [[ax ay az] [bx by_ bz] [cx cy cz]].
      unfold numerator, normal, dot, cross, vsub in *; simpl in *.
      f_equal; apply (Rmult_eq_reg_l _ _ _) with (2 := Q); rewrite Rmult_0_r.
      - replace 0 with ((ax - ox) * 0 + (bx - ox) * 0 + (cx - ox) * 0) by ring.
        rewrite <- K2 at 1; rewrite <- K3 at 1; rewrite <- K1. ring.
      - replace 0 with ((ay - oy) * 0 + (by_ - oy) * 0 + (cy - oy) * 0) by ring.
        rewrite <- K2 at 1; rewrite <- K3 at 1; rewrite <- K1. ring.
      - replace 0 with ((az - oz) * 0 + (bz - oz) * 0 + (cz - oz) * 0) by ring.
        rewrite <- K2 at 1; rewrite <- K3 at 1; rewrite <- K1. ring. }
    split; apply NNPP; intros L; apply K; lra. }
  now apply stay_mixed.
Qed.

(** So a ray of which only the direction is moved, as those that do not see behind their origin,
    meets no triangle that the stored ray is parallel to, but where it begins: at t = 0. *)
Lemma parallel_is_not_met s c : shape_of s = Triangular c -> direction r <> V 0 0 0 ->
  (forall x, origin (path x) = origin r) -> D r s = 0 ->
  eventually (fun x => meets_within (path x) s -> t (path x) s = 0).
Proof.
  intros S N O P. destruct (Req_dec (T r s) 0) as [Q|Q].
  - apply (always _ E). intros x _. unfold t. replace (T (path x) s) with 0; [unfold Rdiv; ring|].
    rewrite <- Q. unfold T, numerator. now rewrite S, O.
  - refine (weaker _ E _ _ _ (parallel_is_missed s c S N P Q)). intros x K V. now destruct K.
Qed.

(** All of a scene together: it is finite. *)
Variables (start : R) (end_ : number) (scene : list surface).
Local Notation met := (met r start end_ scene).

Lemma of_all (P : surface -> A -> Prop) : (forall s, met s -> eventually (P s)) ->
  eventually (fun x => forall s, met s -> P s x).
Proof.
  intros H. refine (weaker _ E _ _ _ (for_all scene (fun s x => met s -> P s x) _)).
  - intros x K s M. apply K; auto. apply M.
  - intros s _. apply given. apply H.
Qed.

Theorem near_enough : eventually (fun x => near_facts r (path x) start end_ scene).
Proof.
  assert (H1 : eventually (fun x => forall s, met s -> meets_within r s ->
    meets_within (path x) s)).
  { apply of_all. intros s _. apply given. apply stays_inside. }
  assert (H2 : eventually (fun x => forall s, met s -> forall s', met s' -> t r s < t r s' ->
    meets_within (path x) s -> meets_within (path x) s' -> t (path x) s < t (path x) s')).
  { apply of_all. intros s M. apply of_all. intros s' M'. apply given.
    apply keeps_order; [apply (closed_D r), M | apply (closed_D r), M']. }
  assert (H3 : eventually (fun x => forall s, In s scene -> D r s <> 0 ->
    meets_within (path x) s -> meets_closed r s)).
  { apply for_all. intros s _. apply given. apply meets_no_more. }
  refine (weaker _ E _ _ _ (both _ E _ _ H1 (both _ E _ _ H2 H3))).
  intros x [K1 [K2 K3]]. split; auto.
Qed.

(** ** The theorem, for all moved rays that are near enough *)

Variable batches : list (list surface).
Variable a : answers.

(** Of one surface and of two: the rule's signs are those of the moved ray. Ties.v *)
Record rule_facts_nearby : Prop := {
  is_crossed_nearby : forall s, met s ->
    eventually (fun x => is_crossed a s = true <-> meets_within (path x) s);
  sign_nearby : forall s s', met s -> met s' ->
    eventually (fun x => meets_within (path x) s -> meets_within (path x) s' ->
      match sign_of_difference a s s' with
      | Lt => t (path x) s < t (path x) s'
      | Gt => t (path x) s' < t (path x) s
      | Eq => same_plane s s'
      end)
}.

Theorem plain_is_right_nearby :
  ray_facts r start end_ scene batches a -> rule_facts_nearby ->
  let result := plain a start end_ batches in
  eventually (fun x => moved_sees r (path x) start end_ scene (owner result)) /\
  match certain result with
  | BOUND | EXACT => clearly_sees r start end_ scene (owner result)
  | AMBIGUOUS => forall answer, ~ clearly_sees r start end_ scene answer
  end /\
  t_of_owner result =
    match owner result with Some s => Some (nearest_float (t r s)) | None => None end.
Proof.
  intros F [H S] result.
  assert (All : eventually (fun x => facts r (path x) start end_ scene batches a)).
  { assert (H' := of_all _ H).
    assert (S' := of_all _ (fun s M => of_all _ (fun s' M' => S s s' M M'))).
    refine (weaker _ E _ _ _ (both _ E _ _ near_enough (both _ E _ _ H' S'))).
    intros x [N [K L]]. split; [exact F | | exact N].
    split; [exact K|]. intros s s' M M'. exact (L s M s' M'). }
  split.
  - refine (weaker _ E _ _ _ All). intros x X. apply (plain_is_right _ _ _ _ _ _ _ X).
  - destruct (somewhere _ E _ All) as [x X]. apply (plain_is_right _ _ _ _ _ _ _ X).
Qed.

End Nearby.

(** ** The rule's ray: along d + (x, x^2, x^3), from o + (y, y^2, y^3) *)

Definition moved_ray (r : ray) (by_ : R * R) : ray :=
  let (x, y) := by_ in
  Ray (vadd (origin r) (V y (y * y) (y * y * y))) (vadd (direction r) (V x (x * x) (x * x * x))).

Lemma rule_comes_near r : @comes_near _ soon (moved_ray r) r.
Proof.
  assert (S := small_filter). assert (F := soon_filter).
  assert (X : @tends _ soon fst 0).
  { intros e H. exists e. split; auto. intros x Hx. apply (always _ S). intros y. simpl.
    rewrite Rminus_0_r, Rabs_pos_eq; lra. }
  assert (Y : @tends _ soon snd 0).
  { intros e H. apply (always _ S). intros x. exists e. split; auto. intros y Hy. simpl.
    rewrite Rminus_0_r, Rabs_pos_eq; lra. }
  assert (M := @tends_mult _ soon F).
  assert (G : forall (f g : R * R -> R) l, @tends _ soon f 0 ->
    (forall x y, g (x, y) = l + f (x, y)) -> @tends _ soon g l).
  { intros f g l H K e He. refine (weaker _ F _ _ _ (H e He)). intros [x y].
    rewrite K. now replace (l + f (x, y) - l) with (f (x, y) - 0) by ring. }
  assert (X2 := M _ _ _ _ X X). rewrite Rmult_0_l in X2.
  assert (X3 := M _ _ _ _ X2 X). rewrite Rmult_0_l in X3.
  assert (Y2 := M _ _ _ _ Y Y). rewrite Rmult_0_l in Y2.
  assert (Y3 := M _ _ _ _ Y2 Y). rewrite Rmult_0_l in Y3.
  repeat split.
  - now apply (G snd).
  - now apply (G (fun p => snd p * snd p)).
  - now apply (G (fun p => snd p * snd p * snd p)).
  - now apply (G fst).
  - now apply (G (fun p => fst p * fst p)).
  - now apply (G (fun p => fst p * fst p * fst p)).
Qed.

(** ** The whole, with nothing left to say of the moved ray but that its signs are the rule's *)

Theorem plain_is_right_by_the_rule r start end_ scene batches a :
  ray_facts r start end_ scene batches a ->
  @rule_facts_nearby _ soon (moved_ray r) r start end_ scene a ->
  let result := plain a start end_ batches in
  (* The owner is what the moved ray sees, for all small x and all much smaller y. *)
  soon (fun by_ => moved_sees r (moved_ray r by_) start end_ scene (owner result)) /\
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
  apply (plain_is_right_nearby soon_filter (moved_ray r) r (rule_comes_near r)).
Qed.
