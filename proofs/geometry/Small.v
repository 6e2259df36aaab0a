(** What holds for everything that is small enough, and the signs of polynomials there. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
Import ListNotations.
Open Scope R_scope.

Definition small (P : R -> Prop) : Prop := exists x0, 0 < x0 /\ forall x, 0 < x < x0 -> P x.

Lemma small_mono (P Q : R -> Prop) : (forall x, 0 < x -> P x -> Q x) -> small P -> small Q.
Proof. intros H (e & E & S). exists e. split; [exact E|]. intros x X. apply H; [lra | now apply S]. Qed.
Lemma small_always (P : R -> Prop) : (forall x, 0 < x -> P x) -> small P.
Proof. intros H. exists 1. split; [lra|]. intros; apply H; lra. Qed.
Lemma small_and (P Q : R -> Prop) : small P -> small Q -> small (fun x => P x /\ Q x).
Proof.
  intros (e & E & S) (f & F & U). exists (Rmin e f). split; [now apply Rmin_pos|].
  intros x X. assert (A := Rmin_l e f). assert (B := Rmin_r e f). split; [apply S | apply U]; lra.
Qed.
(** One x0 does for any finite family: of edges, of triangles, of pairs of hits. *)
Theorem small_family {A} (P : A -> R -> Prop) l :
  (forall a, In a l -> small (P a)) -> small (fun x => forall a, In a l -> P a x).
Proof.
  induction l as [|a l IH]; intros H; [apply small_always; easy|].
  eapply small_mono; [| exact (small_and _ _ (H a (or_introl eq_refl)) (IH (fun b I => H b (or_intror I))))].
  intros x _ [P1 P2] b [<-|I]; auto.
Qed.
Theorem small_exists P : small P -> exists x, 0 < x /\ P x.
Proof. intros (e & E & S). exists (e / 2). split; [lra | apply S; lra]. Qed.
(** First x, then y: infinitely less. *)
Definition small2 (P : R -> R -> Prop) : Prop := small (fun x => small (P x)).
Lemma small2_mono (P Q : R -> R -> Prop) : (forall x y, 0 < x -> 0 < y -> P x y -> Q x y) -> small2 P -> small2 Q.
Proof. intros H. apply small_mono. intros x X. apply small_mono. intros y Y. now apply H. Qed.
Lemma small2_always (P : R -> R -> Prop) : (forall x y, 0 < x -> 0 < y -> P x y) -> small2 P.
Proof. intros H. apply small_always. intros x X. apply small_always. auto. Qed.
Lemma small2_and P Q : small2 P -> small2 Q -> small2 (fun x y => P x y /\ Q x y).
Proof.
  intros H K. eapply small_mono; [| exact (small_and _ _ H K)]. intros x _ [A B]. now apply small_and.
Qed.
Theorem small2_family {A} (P : A -> R -> R -> Prop) l :
  (forall a, In a l -> small2 (P a)) -> small2 (fun x y => forall a, In a l -> P a x y).
Proof.
  intros H. eapply small_mono; [| apply (small_family (fun a x => small (P a x)) l H)].
  intros x _ K. now apply small_family.
Qed.
Theorem small2_exists P : small2 P -> exists x y, 0 < x /\ 0 < y /\ P x y.
Proof.
  intros H. apply small_exists in H. destruct H as (x & X & H). apply small_exists in H.
  destruct H as (y & Y & H). eauto.
Qed.

(** * Signs of polynomials *)

Definition sgn (x : R) : Z := match Rcompare x 0 with Gt => 1 | Lt => -1 | Eq => 0 end.
Lemma sgn_pos x : sgn x = 1%Z <-> 0 < x.
Proof. unfold sgn. destruct (Rcompare_spec x 0); split; intros; try easy; lra. Qed.
Lemma sgn_neg x : sgn x = (-1)%Z <-> x < 0.
Proof. unfold sgn. destruct (Rcompare_spec x 0); split; intros; try easy; lra. Qed.
Lemma sgn_0 x : sgn x = 0%Z <-> x = 0.
Proof. unfold sgn. destruct (Rcompare_spec x 0); split; intros; try easy; lra. Qed.
Lemma sgn_cases x : (sgn x = 1%Z /\ 0 < x) \/ (sgn x = (-1)%Z /\ x < 0) \/ (sgn x = 0%Z /\ x = 0).
Proof. unfold sgn. destruct (Rcompare_spec x 0); auto. Qed.
Lemma sgn_IZR n : sgn (IZR n) = Z.sgn n.
Proof. unfold sgn. rewrite Rcompare_IZR. now destruct n. Qed.
Lemma sgn_same x y : (0 < x <-> 0 < y) -> (x < 0 <-> y < 0) -> sgn x = sgn y.
Proof. intros H K. destruct (sgn_cases x) as [[-> X]|[[-> X]|[-> X]]], (sgn_cases y) as [[-> Y]|[[-> Y]|[-> Y]]]; auto; exfalso; intuition lra. Qed.
Lemma sgn_scale k x : 0 < k -> sgn (k * x) = sgn x.
Proof. intros K. apply sgn_same; split; intros; nra. Qed.
Lemma sgn_opp x : sgn (- x) = (- sgn x)%Z.
Proof. destruct (sgn_cases x) as [[-> X]|[[-> X]|[-> X]]]; [apply sgn_neg | apply sgn_pos | apply sgn_0]; lra. Qed.

(** c0 + c1 x + c2 x^2 + ..., and the first coefficient that is not zero (0 if all are). *)
Fixpoint poly (cs : list R) (x : R) : R := match cs with [] => 0 | c :: cs => c + x * poly cs x end.
Fixpoint first (cs : list R) : R :=
  match cs with [] => 0 | c :: cs => if Req_bool c 0 then first cs else c end.
Lemma first_0 c cs : first (c :: cs) = 0 <-> c = 0 /\ first cs = 0.
Proof. simpl. destruct (Req_bool_spec c 0); intuition lra. Qed.
Lemma first_all cs : first cs = 0 <-> forall c, In c cs -> c = 0.
Proof.
  induction cs as [|c cs IH]; [simpl; tauto|]. rewrite first_0, IH. simpl.
  split; [intros [H K] b [<-|I]; auto | intros H; split; auto].
Qed.
Lemma first_app cs ds : first (cs ++ ds) = if Req_bool (first cs) 0 then first ds else first cs.
Proof.
  induction cs as [|c cs IH]; simpl; [now rewrite Req_bool_true|].
  destruct (Req_bool_spec c 0) as [->|N]; [exact IH | now rewrite Req_bool_false].
Qed.
Lemma poly_zero cs x : first cs = 0 -> poly cs x = 0.
Proof. induction cs as [|c cs IH]; [easy|]. rewrite first_0. intros [-> H]. simpl. rewrite IH; lra. Qed.
Lemma poly_bound cs : exists b, 0 < b /\ forall x, 0 < x < 1 -> Rabs (poly cs x) <= b.
Proof.
  induction cs as [|c cs (b & B & H)]; simpl.
  - exists 1. split; [lra|]. intros. rewrite Rabs_R0. lra.
  - exists (Rabs c + b). split; [generalize (Rabs_pos c); lra|]. intros x X.
    eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_mult, (Rabs_right x) by lra.
    specialize (H x X). assert (P := Rabs_pos (poly cs x)). nra.
Qed.
Theorem sign_of_poly cs : small (fun x => sgn (poly cs x) = sgn (first cs)).
Proof.
  induction cs as [|c cs IH]; [now apply small_always|]. simpl.
  destruct (Req_bool_spec c 0) as [->|N].
  - revert IH. apply small_mono. intros x X <-. rewrite Rplus_0_l. now apply sgn_scale.
  - destruct (poly_bound cs) as (b & B & H).
    assert (C : 0 < Rabs c) by now apply Rabs_pos_lt.
    exists (Rmin 1 (Rabs c / b)). split; [apply Rmin_pos; [lra | now apply Rdiv_lt_0_compat]|].
    intros x X. assert (M1 := Rmin_l 1 (Rabs c / b)). assert (M2 := Rmin_r 1 (Rabs c / b)).
    assert (K : x * b < Rabs c).
    { apply Rlt_le_trans with (Rabs c / b * b); [apply Rmult_lt_compat_r; lra|].
      right. field. lra. }
    assert (P : Rabs (poly cs x) <= b) by (apply H; lra).
    assert (Q : Rabs (x * poly cs x) < Rabs c).
    { rewrite Rabs_mult, (Rabs_right x) by lra. nra. }
    clear - Q. apply sgn_same; revert Q; unfold Rabs;
      destruct (Rcase_abs c), (Rcase_abs (x * poly cs x)); split; intros; lra.
Qed.
(** For the rule's own direction: c0 + c1 x + c2 x^2 + c3 x^3. *)
Corollary sign_of_cubic c0 c1 c2 c3 : exists x0, 0 < x0 /\ forall x, 0 < x < x0 ->
  sgn (c0 + c1 * x + c2 * x ^ 2 + c3 * x ^ 3) = sgn (first [c0; c1; c2; c3]).
Proof.
  destruct (sign_of_poly [c0; c1; c2; c3]) as (e & E & S). exists e. split; [exact E|].
  intros x X. rewrite <- (S x X). f_equal. simpl. ring.
Qed.
(** A polynomial in y with coefficients that are polynomials in x: the first of all, row by row. *)
Lemma sign_of_rows rows :
  small (fun x => sgn (first (map (fun cs => poly cs x) rows)) = sgn (first (concat rows))).
Proof.
  induction rows as [|cs rows IH]; [now apply small_always|].
  eapply small_mono; [| exact (small_and _ _ IH (sign_of_poly cs))].
  intros x _ [H K]. simpl. rewrite first_app. destruct (Req_bool_spec (first cs) 0) as [Z|N].
  - now rewrite Req_bool_true by now apply poly_zero.
  - rewrite Req_bool_false; [exact K|]. intros E. rewrite E in K.
    assert (sgn (first cs) = 0%Z) by (rewrite <- K; now apply sgn_0). now apply sgn_0 in H0.
Qed.
