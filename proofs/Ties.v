(** The rule for ties is one real ray, moved as little as need be. See "Ties" in docs/accuracy.md.

    "For an infinitesimal x" means: for all x > 0 that are small enough; here [small]. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Integers.
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

(** * The moved ray *)

(** u0 + x u1 + x^2 u2 + ... *)
Fixpoint path (moves : list vec) (x : R) : vec :=
  match moves with [] => V 0 0 0 | u :: moves => vadd u (vscale x (path moves x)) end.
(** The direction moves by x u0 + x^2 u1 + ..., the origin by y u0 + y^2 u1 + ... *)
Definition moved_direction d moves x := vadd d (vscale x (path moves x)).
Definition moved (moves : list vec) (r : ray) (x y : R) : ray :=
  Ray (vadd (origin r) (vscale y (path moves y))) (moved_direction (direction r) moves x).

(** The code's [PERTURBATION]: d + (x, x^2, x^3) and o + y (1, y, y^2). *)
Definition PERTURBATION := [I3 1 0 0; I3 0 1 0; I3 0 0 1].
Lemma moved_perturbation r x y : moved (map real PERTURBATION) r x y =
  Ray (vadd (origin r) (vscale y (V 1 y (y ^ 2)))) (vadd (direction r) (V x (x ^ 2) (x ^ 3))).
Proof.
  unfold moved, moved_direction, vadd, vscale; simpl. f_equal; apply V_eq; ring.
Qed.

Lemma dot_path moves m x : dot (path moves x) m = poly (map (fun u => dot u m) moves) x.
Proof.
  induction moves as [|u moves IH]; simpl; [unfold dot; simpl; ring|].
  rewrite <- IH. unfold dot, vadd, vscale; simpl; ring.
Qed.
Lemma dot_moved d moves m x :
  dot (moved_direction d moves x) m = poly (dot d m :: map (fun u => dot u m) moves) x.
Proof. simpl. rewrite <- dot_path. unfold moved_direction, dot, vadd, vscale; simpl; ring. Qed.

(** What depends on how the ray is moved: m on its direction, span on its origin. *)
Definition turned (d m span : vec) (moves : list vec) (x y : R) : R :=
  dot (moved_direction d moves x) m + y * dot (path moves y) (cross span (moved_direction d moves x)).
(** An edge function does, with m = (a - o) x (b - o) and the span a - b; *)
Lemma edge_moved moves r a b x y :
  edge (moved moves r x y) a b =
  turned (direction r) (cross (vsub a (origin r)) (vsub b (origin r))) (vsub a b) moves x y.
Proof.
  unfold turned, moved, edge, dot, cross, vsub, vadd, vscale; simpl; ring.
Qed.
(** and T1 D2 - T2 D1, with T1 n2 - T2 n1 and the span n1 x n2. *)
Definition w_of T1 n1 T2 n2 : vec := vsub (vscale T1 n2) (vscale T2 n1).
Lemma difference_moved moves r p1 n1 p2 n2 x y :
  let r' := moved moves r x y in
  T_of r' p1 n1 * D_of r' n2 - T_of r' p2 n2 * D_of r' n1 =
  turned (direction r) (w_of (T_of r p1 n1) n1 (T_of r p2 n2) n2) (cross n1 n2) moves x y.
Proof.
  unfold turned, moved, w_of, T_of, D_of, dot, cross, vsub, vadd, vscale; simpl; ring.
Qed.

(** * [_sign] *)

(** [for move in moves: if value: break; value = _dot(m, move)] *)
Fixpoint loop (value : Z) (m : Integers) (moves : list Integers) : Z :=
  match moves with
  | [] => value
  | move :: moves => if (value =? 0)%Z then loop (_dot m move) m moves else value
  end.
(** [for along in alongs: value = value or _dot(_cross(span, along), move)] *)
Fixpoint inner (value : Z) (span move : Integers) (alongs : list Integers) : Z :=
  match alongs with
  | [] => value
  | along :: alongs =>
      inner (if (value =? 0)%Z then _dot (_cross span along) move else value) span move alongs
  end.
(** [for move in moves: for along in (d, *moves): ...] *)
Fixpoint outer (value : Z) (span : Integers) (alongs moves : list Integers) : Z :=
  match moves with
  | [] => value
  | move :: moves => outer (inner value span move alongs) span alongs moves
  end.
Definition as_int (b : bool) : Z := if b then 1 else 0.
Definition _sign (value : Z) (m span d : Integers) (moves : list Integers) : Z :=
  let value := loop value m moves in
  let value := if ((value =? 0)%Z && is_zero m)%bool then outer value span (d :: moves) moves else value in
  (as_int (0 <? value) - as_int (value <? 0))%Z.

Definition zfirst (l : list Z) : Z := fold_right (fun a b => if (a =? 0)%Z then b else a) 0%Z l.
Lemma first_IZR l : first (map IZR l) = IZR (zfirst l).
Proof.
  induction l as [|a l IH]; simpl; [easy|]. rewrite IH. destruct (Z.eqb_spec a 0) as [->|N].
  - now rewrite Req_bool_true.
  - rewrite Req_bool_false; [easy | now apply not_0_IZR].
Qed.
Lemma zfirst_app l k : zfirst (l ++ k) = if (zfirst l =? 0)%Z then zfirst k else zfirst l.
Proof.
  induction l as [|a l IH]; simpl; [easy|]. destruct (Z.eqb_spec a 0) as [->|N]; [exact IH|].
  now apply Z.eqb_neq in N as ->.
Qed.
Lemma loop_first moves m : forall value, loop value m moves = zfirst (value :: map (_dot m) moves).
Proof.
  induction moves as [|u moves IH]; intros value; simpl; destruct (Z.eqb_spec value 0) as [->|N]; auto.
  apply IH.
Qed.
Lemma inner_first span u alongs : forall value,
  inner value span u alongs = zfirst (value :: map (fun along => _dot (_cross span along) u) alongs).
Proof.
  induction alongs as [|a alongs IH]; intros value; simpl.
  - now destruct (Z.eqb_spec value 0).
  - rewrite IH. simpl. destruct (Z.eqb_spec value 0) as [->|N]; [easy|].
    now apply Z.eqb_neq in N as ->.
Qed.
Definition rows span alongs moves := map (fun u => map (fun along => _dot (_cross span along) u) alongs) moves.
Lemma outer_first span alongs moves : forall value,
  outer value span alongs moves = zfirst (value :: concat (rows span alongs moves)).
Proof.
  induction moves as [|u moves IH]; intros value; simpl.
  - now destruct (Z.eqb_spec value 0).
  - rewrite IH. cbn [zfirst fold_right]. fold (zfirst (concat (rows span alongs moves))).
    rewrite inner_first, zfirst_app. cbn [zfirst fold_right].
    fold (zfirst (map (fun along => _dot (_cross span along) u) alongs)).
    destruct (Z.eqb_spec value 0) as [->|N]; [easy|]. now apply Z.eqb_neq in N as ->.
Qed.
Lemma Z_cons_eq (x y : Z) l m : x = y -> l = m -> x :: l = y :: m.
Proof. now intros -> ->. Qed.
(** So [_sign] is: the sign of the first that is not zero. *)
Theorem sign_is_first value m span d moves : _sign value m span d moves =
  Z.sgn (zfirst (value :: map (_dot m) moves ++
                 if is_zero m then concat (rows span (d :: moves) moves) else [])).
Proof.
  unfold _sign. rewrite loop_first. set (v := zfirst (value :: map (_dot m) moves)).
  assert (E : zfirst (value :: map (_dot m) moves ++
      if is_zero m then concat (rows span (d :: moves) moves) else []) =
    if ((v =? 0)%Z && is_zero m)%bool then outer v span (d :: moves) moves else v).
  { rewrite app_comm_cons, zfirst_app. fold v. destruct (Z.eqb_spec v 0) as [V|N]; [|easy].
    simpl andb. destruct (is_zero m); [|simpl; congruence]. rewrite outer_first, V. reflexivity. }
  rewrite E. clear E. match goal with |- (as_int (0 <? ?w) - _)%Z = _ => now destruct w end.
Qed.
Lemma sign_value value m span d moves : value <> 0%Z -> _sign value m span d moves = Z.sgn value.
Proof. intros N. rewrite sign_is_first. simpl. now apply Z.eqb_neq in N as ->. Qed.
(** With the code's moves: the first of e, m_x, m_y, m_z. *)
Theorem sign_rule e m span d : m <> ZERO ->
  _sign e m span d PERTURBATION = Z.sgn (zfirst [e; ix m; iy m; iz m]).
Proof.
  intros N. rewrite sign_is_first. destruct (is_zero m) eqn:E; [apply is_zero_spec in E; tauto|].
  unfold _dot; simpl. rewrite !Z.mul_0_r, !Z.mul_1_r, !Z.add_0_l, !Z.add_0_r. reflexivity.
Qed.
(** And where m = 0 = e: the components of c = span x d, each followed by those of span x move. *)
Theorem sign_rule_on_line span d :
  let x := ix span in let y := iy span in let z := iz span in let c := _cross span d in
  _sign 0 ZERO span d PERTURBATION =
  Z.sgn (zfirst [ix c; 0; - z; y;  iy c; z; 0; - x;  iz c; - y; x; 0]%Z).
Proof.
  destruct span as [x y z], d as [a b c]. cbv zeta. rewrite sign_is_first. apply (f_equal Z.sgn).
  apply (f_equal zfirst (x := concat (rows (I3 x y z) (I3 a b c :: PERTURBATION) PERTURBATION))).
  unfold rows, PERTURBATION, _cross, _dot. cbn [concat map app ix iy iz].
  repeat apply Z_cons_eq; reflexivity || ring.
Qed.

(** * The theorem: [_sign] is the sign for the moved ray, whatever the list of moves *)

(** Three vectors that are normal to one are in one plane. *)
Lemma one_plane u v w m : dot u m = 0 -> dot v m = 0 -> dot w m = 0 -> m <> V 0 0 0 ->
  dot u (cross v w) = 0.
Proof.
  destruct u as [a b c], v as [d e f], w as [g h i], m as [x y z]. unfold dot, cross; simpl.
  intros U W X N. set (D := a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)).
  assert (x * D = 0 /\ y * D = 0 /\ z * D = 0) as (P & Q & S).
  { unfold D. repeat split.
    - replace (_ * _) with ((a*x+b*y+c*z) * (e*i-f*h) + (d*x+e*y+f*z) * (h*c-i*b) + (g*x+h*y+i*z) * (b*f-c*e)) by ring.
      rewrite U, W, X. ring.
    - replace (_ * _) with ((a*x+b*y+c*z) * (f*g-d*i) + (d*x+e*y+f*z) * (i*a-g*c) + (g*x+h*y+i*z) * (c*d-a*f)) by ring.
      rewrite U, W, X. ring.
    - replace (_ * _) with ((a*x+b*y+c*z) * (d*h-e*g) + (d*x+e*y+f*z) * (g*b-h*a) + (g*x+h*y+i*z) * (a*e-b*d)) by ring.
      rewrite U, W, X. ring. }
  destruct (Req_dec D 0) as [E|E]; [exact E|]. exfalso. apply N.
  apply Rmult_integral in P, Q, S. f_equal; tauto.
Qed.

Theorem sign_is_of_moved_ray m span d moves : _dot m span = 0%Z ->
  small2 (fun x y => sgn (turned (real d) (real m) (real span) (map real moves) x y) =
                     _sign (_dot d m) m span d moves).
Proof.
  intros P. rewrite sign_is_first, app_comm_cons, zfirst_app.
  set (cs := dot (real d) (real m) :: map (fun u => dot u (real m)) (map real moves)).
  assert (E : first cs = IZR (zfirst (_dot d m :: map (_dot m) moves))).
  { rewrite <- first_IZR. unfold cs. cbn [map]. rewrite real_dot. f_equal. f_equal.
    rewrite !map_map. apply map_ext. intros u. rewrite real_dot. unfold dot. ring. }
  set (v := zfirst _) in *. unfold turned. destruct (Z.eqb_spec v 0) as [V|N].
  - (* the direction decides nothing *)
    rewrite V in E. assert (A := proj1 (first_all cs) E).
    assert (Z : forall x, dot (moved_direction (real d) (map real moves) x) (real m) = 0).
    { intros x. rewrite dot_moved. now apply poly_zero. }
    destruct (is_zero m) eqn:M.
    + (* the origin is moved off the edge's line *)
      set (rs := map (fun u => map (fun along => dot (cross (real span) along) u) (real d :: map real moves)) (map real moves)).
      assert (F : first (concat rs) = IZR (zfirst (concat (rows span (d :: moves) moves)))).
      { rewrite <- first_IZR, concat_map. f_equal. f_equal. unfold rs, rows. rewrite !map_map.
        apply map_ext. intros u. change (real d :: map real moves) with (map real (d :: moves)).
        rewrite !map_map. apply map_ext. intros a. now rewrite real_dot, real_cross. }
      rewrite <- sgn_IZR, <- F. eapply small_mono; [| apply (sign_of_rows rs)].
      intros x X <-. unfold rs. rewrite map_map.
      eapply small_mono; [| apply sign_of_poly]. intros y Y H.
      rewrite Z, Rplus_0_l, sgn_scale, dot_path by exact Y.
      transitivity (sgn (poly (map (fun u => poly (map (fun along => dot (cross (real span) along) u)
        (real d :: map real moves)) x) (map real moves)) y)); [|exact H].
      f_equal. f_equal. apply map_ext. intros u.
      transitivity (dot (moved_direction (real d) (map real moves) x) (cross u (real span))).
      { unfold dot, cross; simpl; ring. }
      rewrite dot_moved. simpl. f_equal; [unfold dot, cross; simpl; ring|]. f_equal. f_equal.
      apply map_ext. intros a. unfold dot, cross; simpl; ring.
    + (* the line that is seen edge-on is moved along itself *)
      simpl. apply small2_always. intros x y X Y. apply sgn_0. rewrite Z, Rplus_0_l.
      rewrite (one_plane (path (map real moves) y) (real span) _ (real m)); [ring| | |apply Z|].
      * rewrite dot_path. apply poly_zero. now apply first_0 in E.
      * apply (f_equal IZR) in P. rewrite real_dot in P. rewrite <- P. unfold dot. ring.
      * intros M'. assert (is_zero m = true); [|congruence]. apply is_zero_spec.
        destruct m as [a b c]. injection M' as Ha Hb Hc. apply eq_IZR in Ha, Hb, Hc.
        now subst.
  - (* the direction decides *)
    eapply small_mono; [| apply (sign_of_poly cs)]. intros x X S. rewrite E, sgn_IZR in S.
    unfold cs in S. rewrite <- dot_moved in S.
    set (c := dot (moved_direction _ _ _) (real m)) in *.
    eapply small_mono; [| apply (sign_of_poly (c :: map (fun u => dot u (cross (real span)
      (moved_direction (real d) (map real moves) x))) (map real moves)))].
    intros y Y H. rewrite dot_path. simpl in H. rewrite Req_bool_false in H; [now rewrite H|].
    intros C. rewrite C in S. replace (sgn 0) with 0%Z in S by (symmetry; now apply sgn_0). lia.
Qed.
