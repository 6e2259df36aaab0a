(** The rule for ties is one real ray, moved as little as need be. See "Ties" in docs/accuracy.md.

    "For an infinitesimal x" means: for all x > 0 that are small enough. That is [small],
    in Small.v; [small2] is for x, and then for all y small enough for that x. *)
Require Import ZArith Reals Psatz List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Small Integers.
Import ListNotations.
Open Scope R_scope.

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

(** One way, as ties.py tries them: d + x u and o + y u. *)
Lemma moved_way u r x y : moved [u] r x y =
  Ray (vadd (origin r) (vscale y u)) (vadd (direction r) (vscale x u)).
Proof. unfold moved, moved_direction, vadd, vscale; simpl. f_equal; apply V_eq; ring. Qed.

Lemma dot_path moves m x : dot (path moves x) m = poly (map (fun u => dot u m) moves) x.
Proof.
  induction moves as [|u moves IH]; simpl; [unfold dot; simpl; ring|].
  rewrite <- IH. unfold dot, vadd, vscale; simpl; ring.
Qed.
Lemma dot_moved d moves m x :
  dot (moved_direction d moves x) m = poly (dot d m :: map (fun u => dot u m) moves) x.
Proof. simpl. rewrite <- dot_path. unfold moved_direction, dot, vadd, vscale; simpl; ring. Qed.

(** The direction alone, along (x, x^2, x^3): the first of e, m_x, m_y, m_z that is not zero. *)
Theorem direction_rule r a b :
  let m := cross (vsub a (origin r)) (vsub b (origin r)) in
  small (fun x => sgn (edge (Ray (origin r) (vadd (direction r) (V x (x ^ 2) (x ^ 3)))) a b) =
                  sgn (first [edge r a b; vx m; vy m; vz m])).
Proof.
  intros m. eapply small_mono; [| apply sign_of_cubic]. intros x _ <-. f_equal.
  rewrite !edge_other. unfold m, dot, cross, vadd, vsub; simpl; ring.
Qed.

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

(** The coefficients in the order of their weight, for real numbers: d . m, m's along the moves; and
    where m is 0, row by row, what the move of the origin adds. *)
Definition is_null m := (Req_bool (vx m) 0 && Req_bool (vy m) 0 && Req_bool (vz m) 0)%bool.
Lemma is_null_spec m : is_null m = true <-> m = V 0 0 0.
Proof.
  destruct m as [x y z]. unfold is_null; simpl.
  destruct (Req_bool_spec x 0), (Req_bool_spec y 0), (Req_bool_spec z 0); simpl;
    split; try discriminate; try (intros [= -> -> ->]; tauto); now subst.
Qed.
Definition real_rows span alongs moves :=
  map (fun u => map (fun along => dot (cross span along) u) alongs) moves.
Definition coefficients d m span moves : list R :=
  (dot d m :: map (fun u => dot u m) moves) ++
  if is_null m then concat (real_rows span (d :: moves) moves) else [].
Theorem sign_of_turned d m span moves : dot m span = 0 ->
  small2 (fun x y => sgn (turned d m span moves x y) = sgn (first (coefficients d m span moves))).
Proof.
  intros P. unfold coefficients. rewrite first_app.
  set (cs := dot d m :: map (fun u => dot u m) moves). unfold turned.
  destruct (Req_bool_spec (first cs) 0) as [V|N].
  - (* the direction decides nothing *)
    assert (Z : forall x, dot (moved_direction d moves x) m = 0).
    { intros x. rewrite dot_moved. now apply poly_zero. }
    destruct (is_null m) eqn:M.
    + (* the origin is moved off the edge's line *)
      set (rs := real_rows span (d :: moves) moves).
      eapply small_mono; [| apply (sign_of_rows rs)].
      intros x X <-. unfold rs, real_rows. rewrite map_map.
      eapply small_mono; [| apply sign_of_poly]. intros y Y H.
      rewrite Z, Rplus_0_l, sgn_scale, dot_path by exact Y.
      etransitivity; [|exact H]. f_equal. f_equal. apply map_ext. intros u.
      transitivity (dot (moved_direction d moves x) (cross u span)).
      { unfold dot, cross; simpl; ring. }
      rewrite dot_moved. simpl. f_equal; [unfold dot, cross; simpl; ring|]. f_equal. f_equal.
      apply map_ext. intros a. unfold dot, cross; simpl; ring.
    + (* a line that is not seen end-on is moved along itself *)
      apply small2_always. intros x y X Y. apply (f_equal sgn). rewrite Z, Rplus_0_l.
      rewrite (one_plane (path moves y) span _ m); [simpl; ring| | |apply Z|].
      * rewrite dot_path. apply poly_zero. now apply first_0 in V.
      * rewrite <- P. unfold dot. ring.
      * intros M'. apply is_null_spec in M'. congruence.
  - (* the direction decides *)
    eapply small_mono; [| apply (sign_of_poly cs)]. intros x X S.
    unfold cs in S at 1. rewrite <- dot_moved in S. set (c := dot (moved_direction _ _ _) m) in *.
    eapply small_mono; [| apply (sign_of_poly (c :: map (fun u => dot u (cross span (moved_direction d moves x))) moves))].
    intros y Y H. rewrite dot_path. simpl in H. rewrite Req_bool_false in H; [now rewrite H|].
    intros C. apply N, sgn_0. rewrite <- S. now apply sgn_0.
Qed.

(** The code's list has their signs, whatever power of two each vector is scaled by (Integers.v). *)
Definition like (x : R) (n : Z) := exists k, 0 < k /\ x = k * IZR n.
Lemma first_like l k : Forall2 like l k -> sgn (first l) = Z.sgn (zfirst k).
Proof.
  induction 1 as [|x n l k (f & F & ->) _ IH]; simpl; [now apply sgn_0|].
  destruct (Z.eqb_spec n 0) as [->|N].
  - now rewrite Rmult_0_r, Req_bool_true.
  - apply not_0_IZR in N. rewrite Req_bool_false, sgn_scale, sgn_IZR; auto.
    apply Rmult_integral_contrapositive_currified; lra.
Qed.
Lemma like_map {A} (f : A -> R) (g : A -> Z) l : (forall a, like (f a) (g a)) -> Forall2 like (map f l) (map g l).
Proof. intros H. induction l; simpl; constructor; auto. Qed.
Theorem sign_is_of_moved_ray m span d moves a b c : _dot m span = 0%Z -> 0 < a -> 0 < b -> 0 < c ->
  small2 (fun x y =>
    sgn (turned (vscale a (real d)) (vscale b (real m)) (vscale c (real span)) (map real moves) x y) =
    _sign (_dot d m) m span d moves).
Proof.
  intros P A B C. eapply small2_mono; [| apply sign_of_turned].
  - intros x y _ _ ->. rewrite sign_is_first, app_comm_cons. apply first_like. unfold coefficients.
    assert (Z : is_null (vscale b (real m)) = is_zero m).
    { apply eq_iff_eq_true. rewrite is_null_spec, is_zero_spec. split.
      - destruct m as [u v w]. unfold vscale, real; simpl. intros [= U V W].
        unfold ZERO. f_equal; apply eq_IZR; nra.
      - intros ->. unfold vscale, real; simpl. apply V_eq; ring. }
    rewrite Z. apply Forall2_app; [constructor|].
    + exists (a * b). split; [nra|]. rewrite real_dot. unfold dot, vscale; simpl; ring.
    + rewrite map_map. apply like_map. intros u. exists b. split; [exact B|].
      rewrite real_dot. unfold dot, vscale; simpl; ring.
    + destruct (is_zero m); [|constructor]. unfold real_rows, rows. rewrite map_map.
      induction moves as [|u us IH] at 2 4; [constructor|].
      cbn [map concat app]. rewrite !app_comm_cons. apply Forall2_app; [|exact IH].
      constructor; [|rewrite map_map; apply like_map; intros e].
      * exists (c * a). split; [nra|]. rewrite real_dot, real_cross. unfold dot, cross, vscale; simpl; ring.
      * exists c. split; [exact C|]. rewrite real_dot, real_cross. unfold dot, cross, vscale; simpl; ring.
  - apply (f_equal IZR) in P. rewrite real_dot in P.
    transitivity (b * c * dot (real m) (real span)); [unfold dot, vscale; simpl; ring|]. rewrite P. ring.
Qed.
