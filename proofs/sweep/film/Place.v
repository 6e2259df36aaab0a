(** How far rounding moves a vertex, and a ray, along one axis of the film ([film.py], [camera.py]).

    [near a b e] is |a - b| <= e. Every definition is what the code computes, a [rnd] for each of its
    operations, in its order; every lemma says how far that is from the same without rounding. *)
Require Import ZArith Reals Psatz String List.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Camera.
Import ListNotations.
Open Scope R_scope.

(** ** Numbers that are near one another *)

Definition near (a b e : R) : Prop := Rabs (a - b) <= e.

Lemma near_add a b c d e f : near a b e -> near c d f -> near (a + c) (b + d) (e + f).
Proof. unfold near. intros H K. apply Rabs_le_inv in H, K. apply Rabs_le. lra. Qed.
Lemma near_sub a b c d e f : near a b e -> near c d f -> near (a - c) (b - d) (e + f).
Proof. unfold near. intros H K. apply Rabs_le_inv in H, K. apply Rabs_le. lra. Qed.
Lemma near_trans a b c e f : near a b e -> near b c f -> near a c (e + f).
Proof. unfold near. intros H K. apply Rabs_le_inv in H, K. apply Rabs_le. lra. Qed.
Lemma near_sym a b e : near a b e -> near b a e.
Proof. unfold near. now rewrite Rabs_minus_sym. Qed.
Lemma near_le a b e f : near a b e -> e <= f -> near a b f.
Proof. unfold near. lra. Qed.
Lemma near_abs a b e B : near a b e -> Rabs b <= B -> Rabs a <= B + e.
Proof. unfold near. intros H K. apply Rabs_le_inv in H, K. apply Rabs_le. lra. Qed.
Lemma near_scale c a b e : near a b e -> near (c * a) (c * b) (Rabs c * e).
Proof.
  unfold near. intros H. rewrite <- Rmult_minus_distr_l, Rabs_mult.
  apply Rmult_le_compat_l; [apply Rabs_pos | exact H].
Qed.
Lemma near_mul a b c d e f B : near a b e -> near c d f -> Rabs b <= B ->
  near (a * c) (b * d) (e * Rabs c + B * f).
Proof.
  unfold near. intros H K L. replace (a * c - b * d) with ((a - b) * c + b * (c - d)) by ring.
  eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult.
  apply Rplus_le_compat; [apply Rmult_le_compat_r | apply Rmult_le_compat]; auto using Rabs_pos.
Qed.
Lemma u_tiny : u <= / 1000000000000000. Proof. generalize u_small. lra. Qed.
Lemma eta_u6 : eta <= u / 1000000.
Proof.
  unfold eta, u. replace (-1074)%Z with (-1022 + -52)%Z by reflexivity. rewrite bpow_plus.
  assert (bpow radix2 (-1022) <= / 1000000).
  { apply Rle_trans with (bpow radix2 (-20)); [apply bpow_le; lia | simpl; lra]. }
  generalize (bpow_gt_0 radix2 (-52)). nra.
Qed.
(** A rounding more; its own error on top of the others' is next to nothing. *)
Lemma near_rnd a b e B E : near a b e -> Rabs b <= B ->
  e * (1 + / 10000) + u * B + eta <= E -> near (rnd a) b E.
Proof.
  unfold near. intros H K L. assert (A := near_abs _ _ _ _ H K). assert (R := rnd_err a).
  assert (P := u_pos). assert (T := u_tiny). assert (0 <= e) by (generalize (Rabs_pos (a - b)); lra).
  replace (rnd a - b) with ((rnd a - a) + (a - b)) by ring.
  eapply Rle_trans; [apply Rabs_triang|].
  assert (u * Rabs a <= u * (B + e)) by (apply Rmult_le_compat_l; lra).
  assert (u * e <= / 10000 * e) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(** ** Expressions of +, - and *, by the theorem of [Rounding.v] *)

Fixpoint pick (l : list (string * R)) (name : string) : R :=
  match l with (n, x) :: m => if String.eqb n name then x else pick m name | [] => 0 end.
Lemma pick_float l : Forall is_float (map snd l) -> forall name, is_float (pick l name).
Proof.
  induction l as [|[n x] l IH]; simpl; intros H name; [apply generic_format_0|].
  inversion H; subst. destruct (String.eqb n name); auto.
Qed.
Definition given (l : list (string * R)) : renv := REnv (pick l) (fun _ => false).
Definition floats (v : vec) := is_float (vx v) /\ is_float (vy v) /\ is_float (vz v).

Lemma A_4 : A 4 <= 1 + 5 * u. Proof. unfold A. rewrite u_value. simpl. lra. Qed.
Lemma A_3 : A 3 <= 1 + 4 * u. Proof. unfold A. rewrite u_value. simpl. lra. Qed.
Lemma A_small n m g k : A n <= 1 + k * u -> k * u <= / 2 -> 0 <= m -> 0 <= g ->
  A n * (m + g) - m <= k * u * m + 3 / 2 * g.
Proof. intros. assert (A n * (m + g) <= (1 + k * u) * (m + g)) by (apply Rmult_le_compat_r; lra). nra. Qed.

(** [q = world - camera.origin], and [d[0] * q[0] + d[1] * q[1] + d[2] * q[2]]. *)
Definition fsub (v o : vec) := V (rnd (vx v - vx o)) (rnd (vy v - vy o)) (rnd (vz v - vz o)).
Definition fdot (d q : vec) :=
  rnd (rnd (rnd (vx d * vx q) + rnd (vy d * vy q)) + rnd (vz d * vz q)).
Definition L1 (v : vec) := Rabs (vx v) + Rabs (vy v) + Rabs (vz v).
Definition within (v : vec) (b : R) := Rabs (vx v) <= b /\ Rabs (vy v) <= b /\ Rabs (vz v) <= b.

Lemma L1_pos v : 0 <= L1 v.
Proof. unfold L1. generalize (Rabs_pos (vx v)) (Rabs_pos (vy v)) (Rabs_pos (vz v)). lra. Qed.
Lemma dot_L1 d v b : within v b -> Rabs (dot d v) <= L1 d * b.
Proof.
  intros [X [Y Z]]. unfold dot, L1. eapply Rle_trans; [apply Rabs_triang|].
  eapply Rle_trans; [apply Rplus_le_compat_r, Rabs_triang|]. rewrite !Rabs_mult.
  generalize (Rmult_le_compat_l _ _ _ (Rabs_pos (vx d)) X) (Rmult_le_compat_l _ _ _ (Rabs_pos (vy d)) Y)
    (Rmult_le_compat_l _ _ _ (Rabs_pos (vz d)) Z). lra.
Qed.

Lemma fdot_fsub d v o Y : floats d -> floats v -> floats o -> within (vsub v o) Y ->
  near (fdot d (fsub v o)) (dot d (vsub v o)) (5 * u * (L1 d * Y) + 5 * eta).
Proof.
  intros [D0 [D1 D2]] [V0 [V1 V2]] [O0 [O1 O2]] [W0 [W1 W2]]. unfold near.
  set (env := given [("d0", vx d); ("d1", vy d); ("d2", vz d); ("v0", vx v); ("v1", vy v);
    ("v2", vz v); ("o0", vx o); ("o1", vy o); ("o2", vz o)]%string).
  set (t d v o := Mul (Var d) (Sub (Var v) (Var o))).
  assert (F : forall name, is_float (r_var env name)).
  { apply pick_float. simpl. repeat constructor; assumption. }
  generalize (error env F (Add (Add (t "d0" "v0" "o0") (t "d1" "v1" "o1")) (t "d2" "v2" "o2"))%string
    ltac:(simpl; tauto)).
  change (Rounding.depth _) with 4%nat. simpl in W0, W1, W2 |- *.
  change (value rnd env _) with (fdot d (fsub v o)) || idtac.
  intros H. eapply Rle_trans; [exact H|]. clear H.
  set (a := Rabs (vx d) * Rabs (vx v - vx o)). set (b := Rabs (vy d) * Rabs (vy v - vy o)).
  set (c := Rabs (vz d) * Rabs (vz v - vz o)).
  assert (a <= Rabs (vx d) * Y) by (apply Rmult_le_compat_l; auto using Rabs_pos).
  assert (b <= Rabs (vy d) * Y) by (apply Rmult_le_compat_l; auto using Rabs_pos).
  assert (c <= Rabs (vz d) * Y) by (apply Rmult_le_compat_l; auto using Rabs_pos).
  assert (0 <= a /\ 0 <= b /\ 0 <= c) by (repeat split; apply Rmult_le_pos; apply Rabs_pos).
  replace (a + eta + (b + eta) + (c + eta)) with (a + b + c + 3 * eta) by ring.
  assert (E := eta_pos). assert (P := u_pos). assert (T := u_tiny).
  generalize (A_small 4 (a + b + c) (3 * eta) 5 A_4 ltac:(lra) ltac:(lra) ltac:(lra)).
  assert (u * (a + b + c) <= u * (L1 d * Y)) by (apply Rmult_le_compat_l; unfold L1; lra).
  intros; lra.
Qed.

(** ** One axis of the film *)

(** [(right - window.left * w) * (1 / width) - self.dx * w]. *)
Definition film_position (X w left width dx : R) :=
  rnd (rnd (rnd (X - rnd (left * w)) * rnd (1 / width)) - rnd (dx * w)).
(** [camera.py]: [film_positions], and x in [camera_rays]. *)
Definition film_at (i dx : R) := rnd (rnd (i + / 2) + dx).
Definition window_at (left px width : R) := rnd (left + rnd (px * width)).

Lemma near_refl a : near a a 0. Proof. unfold near. replace (a - a) with 0 by ring. rewrite Rabs_R0. lra. Qed.
Lemma tri a b A B : Rabs a <= A -> Rabs b <= B -> Rabs (a - b) <= A + B.
Proof. intros H K. apply Rabs_le_inv in H, K. apply Rabs_le. lra. Qed.
Lemma tri' a b A B : Rabs a <= A -> Rabs b <= B -> Rabs (a + b) <= A + B.
Proof. intros H K. apply Rabs_le_inv in H, K. apply Rabs_le. lra. Qed.
Lemma prod a b A B : Rabs a <= A -> Rabs b <= B -> Rabs (a * b) <= A * B.
Proof. intros H K. rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. Qed.

(** N is S Z, and M what the film's scale w is at most: N for a perspective camera, 1 for a parallel
    one. The coordinates are off by at most 106 u of these. *)
Lemma film_place X X0 w w0 left width dx N M :
  near X X0 (106 * (u * N)) -> near w w0 (106 * (u * M)) ->
  Rabs X0 <= 101 / 100 * N -> Rabs w0 <= 101 / 100 * M ->
  bpow radix2 (-1020) <= width <= bpow radix2 1000 -> Rabs dx <= / 2 ->
  eta <= u * N / 100 -> eta <= u * M / 100 ->
  near (film_position X w left width dx) ((X0 - left * w0) / width - dx * w0)
    (u * (111 * N + 112 * (Rabs left * M)) / width + 55 * (u * M)).
Proof.
  intros HX Hw BX Bw [W1 W2] Hdx EN EM. unfold film_position. set (l := Rabs left).
  assert (Pu := u_pos). assert (Tu := u_tiny). assert (Pe := eta_pos). assert (Pl : 0 <= l) by apply Rabs_pos.
  assert (PN : 0 < u * N) by lra. assert (PM : 0 < u * M) by lra.
  assert (N0 : 0 <= N) by (apply (Rmult_le_reg_l u); lra).
  assert (M0 : 0 <= M) by (apply (Rmult_le_reg_l u); lra).
  assert (Pw : 0 < width) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact W1]).
  set (k := / width). assert (Pk : 0 < k) by now apply Rinv_0_lt_compat.
  assert (Kr : near (rnd (1 / width)) k (u * k)).
  { unfold Rdiv. rewrite Rmult_1_l. fold k. unfold near. rewrite <- (Rabs_pos_eq k) at 3 by lra.
    apply rnd_err_rel. rewrite Rabs_pos_eq by lra. unfold k. apply Rle_trans with (/ bpow radix2 1000).
    - rewrite <- bpow_opp. apply bpow_le. lia.
    - apply Rinv_le; lra. }
  set (a := u * N) in *. set (c := u * (l * M)). assert (Pc : 0 <= c).
  { apply Rmult_le_pos; [lra | now apply Rmult_le_pos]. }
  assert (S1 : near (rnd (left * w)) (left * w0) (1072 / 10 * c + eta)).
  { apply near_rnd with (e := l * (106 * (u * M))) (B := l * (101 / 100 * M)).
    - now apply near_scale.
    - apply prod; [apply Rle_refl | exact Bw].
    - replace (l * (106 * (u * M))) with (106 * c) by (unfold c; ring).
      replace (u * (l * (101 / 100 * M))) with (101 / 100 * c) by (unfold c; ring). lra. }
  assert (B2 : Rabs (X0 - left * w0) <= 101 / 100 * (N + l * M)).
  { replace (101 / 100 * (N + l * M)) with (101 / 100 * N + l * (101 / 100 * M)) by ring.
    apply tri; [exact BX | apply prod; [apply Rle_refl | exact Bw]]. }
  assert (S2 : near (rnd (X - rnd (left * w))) (X0 - left * w0) (1072 / 10 * a + 1083 / 10 * c + 21 / 10 * eta)).
  { eapply near_rnd; [now apply near_sub; [exact HX | exact S1] | exact B2 |].
    replace (u * (101 / 100 * (N + l * M))) with (101 / 100 * (a + c)) by (unfold a, c; ring). lra. }
  set (V := (X0 - left * w0)) in *. set (m2 := rnd (X - rnd (left * w))) in *.
  assert (BV : Rabs (V * k) <= 101 / 100 * (N + l * M) * k).
  { apply prod; [exact B2 | rewrite Rabs_pos_eq; lra]. }
  assert (Ka : Rabs (rnd (1 / width)) <= 10001 / 10000 * k).
  { assert (H := near_abs _ _ _ k Kr ltac:(rewrite Rabs_pos_eq; lra)).
    assert (u * k <= / 10000 * k) by (apply Rmult_le_compat_r; lra). lra. }
  assert (S4 : near (rnd (m2 * rnd (1 / width))) (V * k)
                 (1095 / 10 * (a * k) + 1106 / 10 * (c * k) + 23 / 10 * (eta * k) + eta)).
  { eapply near_rnd; [apply (near_mul _ _ _ _ _ _ _ S2 Kr B2) | exact BV |].
    set (e := 1072 / 10 * a + 1083 / 10 * c + 21 / 10 * eta) in *.
    assert (e * Rabs (rnd (1 / width)) <= e * (10001 / 10000 * k)).
    { apply Rmult_le_compat_l; [unfold e; lra | exact Ka]. }
    replace (101 / 100 * (N + l * M) * (u * k)) with (101 / 100 * (a * k + c * k)) by (unfold a, c; ring).
    replace (u * (101 / 100 * (N + l * M) * k)) with (101 / 100 * (a * k + c * k)) by (unfold a, c; ring).
    assert (e * (10001 / 10000 * k) = 10001 / 10000 * (1072 / 10 * (a * k) + 1083 / 10 * (c * k) + 21 / 10 * (eta * k)))
      by (unfold e; ring).
    assert (0 < a * k) by now apply Rmult_lt_0_compat. assert (0 <= c * k) by (apply Rmult_le_pos; lra).
    assert (0 < eta * k) by now apply Rmult_lt_0_compat. lra. }
  assert (Bd : Rabs (dx * w0) <= / 2 * (101 / 100 * M)) by (apply prod; assumption).
  assert (S5 : near (rnd (dx * w)) (dx * w0) (537 / 10 * (u * M) + eta)).
  { eapply near_rnd; [apply near_scale, Hw | exact Bd |].
    assert (Rabs dx * (106 * (u * M)) <= / 2 * (106 * (u * M))) by (apply Rmult_le_compat_r; lra).
    replace (u * (/ 2 * (101 / 100 * M))) with (101 / 200 * (u * M)) by field. lra. }
  assert (0 < a * k) by now apply Rmult_lt_0_compat. assert (0 <= c * k) by (apply Rmult_le_pos; lra).
  assert (eta * k <= a / 100 * k) by (apply Rmult_le_compat_r; lra).
  assert (0 < eta * k) by now apply Rmult_lt_0_compat.
  eapply near_rnd.
  - apply near_sub; [exact S4 | exact S5].
  - apply tri; [exact BV | exact Bd].
  - replace (u * (101 / 100 * (N + l * M) * k + / 2 * (101 / 100 * M)))
      with (101 / 100 * (a * k + c * k) + 101 / 200 * (u * M)) by (unfold a, c; field).
    replace (u * (111 * N + 112 * (l * M)) / width) with (111 * (a * k) + 112 * (c * k))
      by (unfold a, c, k; field; lra). lra.
Qed.

Lemma eta_pixel width : bpow radix2 (-1020) <= width -> eta <= u * width / 4.
Proof.
  intros H. unfold eta, u. replace (-1074)%Z with (-52 + (-2 + -1020))%Z by reflexivity.
  rewrite !bpow_plus. assert (bpow radix2 (-2) = / 4) by (simpl; lra). rewrite H0.
  generalize (bpow_gt_0 radix2 (-52)) (bpow_gt_0 radix2 (-1020)). nra.
Qed.

(** Where a ray passes the window: off by less than the 128 u that [film] has for it. *)
Lemma window_near left width n i dx :
  bpow radix2 (-1020) <= width -> 0 <= i -> i + 1 <= n -> Rabs dx <= / 2 ->
  near (window_at left (film_at i dx) width) (left + (i + / 2 + dx) * width)
    (u * (Rabs left + 5 * n * width)).
Proof.
  intros Hw I0 I1 D. assert (E := eta_pixel _ Hw). assert (Pu := u_pos). assert (Tu := u_tiny).
  assert (Pe := eta_pos). assert (Pw : 0 < width) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact Hw]).
  apply Rabs_le_inv in D.
  assert (un : u * 1 <= u * n) by (apply Rmult_le_compat_l; lra).
  assert (eu : eta <= u / 100).
  { unfold eta, u. replace (-1074)%Z with (-1022 + -52)%Z by reflexivity. rewrite bpow_plus.
    assert (bpow radix2 (-1022) <= / 100).
    { apply Rle_trans with (bpow radix2 (-7)); [apply bpow_le; lia | simpl; lra]. }
    generalize (bpow_gt_0 radix2 (-52)). nra. }
  assert (S0 : near (rnd (i + / 2)) (i + / 2) (11 / 10 * (u * n))).
  { apply near_rnd with (e := 0) (B := n); [apply near_refl | rewrite Rabs_pos_eq; lra | lra]. }
  assert (S1 : near (film_at i dx) (i + / 2 + dx) (22 / 10 * (u * n))).
  { unfold film_at. apply near_rnd with (e := 11 / 10 * (u * n)) (B := n); [| rewrite Rabs_pos_eq; lra | lra].
    generalize (near_add _ _ _ _ _ _ S0 (near_refl dx)). rewrite Rplus_0_r. auto. }
  assert (uw : u * width * 1 <= u * width * n) by (apply Rmult_le_compat_l; [apply Rmult_le_pos|]; lra).
  assert (P3 : 0 < u * width) by now apply Rmult_lt_0_compat.
  assert (B : Rabs ((i + / 2 + dx) * width) <= n * width).
  { apply prod; rewrite Rabs_pos_eq; lra. }
  assert (S2 : near (rnd (film_at i dx * width)) ((i + / 2 + dx) * width) (36 / 10 * (u * width * n))).
  { eapply near_rnd; [rewrite 2!(Rmult_comm _ width); apply near_scale, S1 | exact B |].
    rewrite Rabs_pos_eq by lra. 
    replace (width * (22 / 10 * (u * n))) with (22 / 10 * (u * width * n)) by ring.
    replace (u * (n * width)) with (u * width * n) by ring. lra. }
  unfold window_at. eapply near_rnd.
  - apply near_add; [apply near_refl | exact S2].
  - apply tri'; [apply Rle_refl | exact B].
  - assert (0 <= u * Rabs left) by (apply Rmult_le_pos; [lra | apply Rabs_pos]).
    replace (u * (Rabs left + n * width)) with (u * Rabs left + u * width * n) by ring.
    replace (u * (Rabs left + 5 * n * width)) with (u * Rabs left + 5 * (u * width * n)) by ring. lra.
Qed.

(** A ray's direction: [x * right + y * up], then [+ forward]. *)
Definition ray_part (x y r p f : R) := rnd (rnd (rnd (x * r) + rnd (y * p)) + f).
Definition fdirection (x y : R) (right up forward : vec) :=
  V (ray_part x y (vx right) (vx up) (vx forward)) (ray_part x y (vy right) (vy up) (vy forward))
    (ray_part x y (vz right) (vz up) (vz forward)).

Lemma ray_part_near x y r p f m X Y :
  is_float x -> is_float y -> is_float r -> is_float p -> is_float f ->
  Rabs x <= X -> Rabs y <= Y -> Rabs r <= m -> Rabs p <= m -> 
  near (ray_part x y r p f) (x * r + y * p + f) (4 * u * (m * (X + Y) + Rabs f) + 3 * eta).
Proof.
  intros Fx Fy Fr Fp Ff BX BY Br Bp. unfold near.
  set (env := given [("x", x); ("y", y); ("r", r); ("p", p); ("f", f)]%string).
  assert (F : forall name, is_float (r_var env name)).
  { apply pick_float. simpl. repeat constructor; assumption. }
  generalize (error env F (Add (Add (Mul (Var "x") (Var "r")) (Mul (Var "y") (Var "p"))) (Var "f"))%string
    ltac:(simpl; tauto)).
  change (Rounding.depth _) with 3%nat. simpl.
  intros H. eapply Rle_trans; [exact H|]. clear H.
  assert (H1 : Rabs x * Rabs r <= X * m) by (apply Rmult_le_compat; auto using Rabs_pos).
  assert (H2 : Rabs y * Rabs p <= Y * m) by (apply Rmult_le_compat; auto using Rabs_pos).
  set (a := Rabs x * Rabs r) in *. set (b := Rabs y * Rabs p) in *. set (c := Rabs f).
  assert (0 <= a /\ 0 <= b) by (split; apply Rmult_le_pos; apply Rabs_pos).
  assert (0 <= c) by apply Rabs_pos.
  replace (a + eta + (b + eta) + c) with (a + b + c + 2 * eta) by ring.
  assert (E := eta_pos). assert (P := u_pos). assert (T := u_tiny).
  generalize (A_small 3 (a + b + c) (2 * eta) 4 A_3 ltac:(lra) ltac:(lra) ltac:(lra)).
  assert (u * (a + b + c) <= u * (m * (X + Y) + c)) by (apply Rmult_le_compat_l; lra).
  intros; lra.
Qed.

(** The window along one axis: where it begins, its pixels' width and number, and the largest that
    a ray's place on it may be ([_reach], but for roundings). *)
Record axis := Axis { start : R; pixel : R; count : R; reach : R }.
Definition axis_ok (a : axis) :=
  bpow radix2 (-1020) <= pixel a <= bpow radix2 1000 /\ 1 <= count a /\ 0 <= reach a.
(** Pixel i, whose rays pass its centre at dx, exactly and as [camera_rays] has them. *)
Definition in_picture (a : axis) (i dx : R) :=
  0 <= i /\ i + 1 <= count a /\ Rabs dx <= / 2 /\
  Rabs (window_at (start a) (film_at i dx) (pixel a)) <= 101 / 100 * reach a.

(** ** A vertex's coordinates, from dual axes that are off by at most 100 u S *)
Section Vertex.
Variable o : vec.
Hypothesis Fo : floats o.
Variables s S : R. (* the factor that the dual axes have in common; their size *)
Hypothesis S_some : 1 <= S.
Hypothesis s_some : Rabs (s - 1) <= / 100.
Definition off_by (d exact : vec) := L1 (vsub d (vscale s exact)).

Lemma s_range : 99 / 100 <= s <= 101 / 100.
Proof. generalize (Rabs_le_inv _ _ s_some). lra. Qed.

Lemma L1_dual d e : off_by d e <= 100 * (u * S) -> L1 d <= 1001 / 1000 * S ->
  L1 (vscale s e) <= 1002 / 1000 * S /\ L1 e <= 102 / 100 * S.
Proof.
  intros H K. assert (P := u_pos). assert (T := u_tiny). assert (Q := s_range).
  assert (u * S <= / 1000000000000000 * S) by (apply Rmult_le_compat_r; lra).
  assert (A : L1 (vscale s e) <= L1 d + off_by d e).
  { unfold off_by, L1, vsub, vscale; simpl. destruct d as [a b c], e as [x y z]; simpl.
    generalize (tri a (a - s * x) _ _ (Rle_refl _) (Rle_refl _)) (tri b (b - s * y) _ _ (Rle_refl _) (Rle_refl _))
      (tri c (c - s * z) _ _ (Rle_refl _) (Rle_refl _)).
    replace (a - (a - s * x)) with (s * x) by ring. replace (b - (b - s * y)) with (s * y) by ring.
    replace (c - (c - s * z)) with (s * z) by ring. lra. }
  assert (B : L1 (vscale s e) = s * L1 e).
  { unfold L1, vscale; simpl. rewrite !Rabs_mult, (Rabs_pos_eq s) by lra. ring. }
  split; [lra|]. assert (99 / 100 * L1 e <= s * L1 e) by (apply Rmult_le_compat_r; [apply L1_pos | lra]). lra.
Qed.

Variables (v : vec) (Z : R).
Hypothesis v_float : floats v.
Hypothesis v_size : within (vsub v o) (1001 / 1000 * Z).
Hypothesis Z_some : bpow radix2 (-970) <= Z.

Lemma eta_size : eta <= u * Z / 100.
Proof.
  apply Rle_trans with (u * bpow radix2 (-970) / 100).
  - unfold eta, u. replace (-1074)%Z with (-52 + (-52 + -970))%Z by reflexivity. rewrite !bpow_plus.
    assert (bpow radix2 (-52) <= / 100).
    { apply Rle_trans with (bpow radix2 (-7)); [apply bpow_le; lia | simpl; lra]. }
    generalize (bpow_gt_0 radix2 (-52)) (bpow_gt_0 radix2 (-970)). intros A B.
    assert (bpow radix2 (-52) * bpow radix2 (-970) <= / 100 * bpow radix2 (-970)) by nra. nra.
  - apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; [apply Rlt_le, u_pos | exact Z_some].
Qed.
Lemma Z_pos : 0 < Z. Proof. eapply Rlt_le_trans; [apply bpow_gt_0 | exact Z_some]. Qed.
Lemma eta_unit : eta <= u * (S * Z) / 100.
Proof.
  apply Rle_trans with (u * Z / 100); [exact eta_size|]. apply Rmult_le_compat_r; [lra|].
  apply Rmult_le_compat_l; [apply Rlt_le, u_pos|]. assert (P := Z_pos). nra.
Qed.

Lemma coordinate d e : floats d -> off_by d e <= 100 * (u * S) -> L1 d <= 1001 / 1000 * S ->
  near (fdot d (fsub v o)) (s * dot e (vsub v o)) (106 * (u * (S * Z))) /\
  Rabs (s * dot e (vsub v o)) <= 101 / 100 * (S * Z).
Proof.
  intros F H K. assert (P := u_pos). assert (E := eta_unit). assert (PZ := Z_pos).
  destruct (L1_dual d e H K) as [B _].
  assert (M : s * dot e (vsub v o) = dot (vscale s e) (vsub v o)) by (unfold dot, vscale; simpl; ring).
  split.
  - eapply near_le; [eapply near_trans; [now apply fdot_fsub; try exact v_size|]|].
    + unfold near. rewrite M.
      replace (dot d (vsub v o) - dot (vscale s e) (vsub v o))
        with (dot (vsub d (vscale s e)) (vsub v o)) by (unfold dot, vscale, vsub; simpl; ring).
      apply (dot_L1 _ _ _ v_size).
    + fold (off_by d e).
      assert (5 * u * (L1 d * (1001 / 1000 * Z)) <= 5 * u * (1001 / 1000 * S * (1001 / 1000 * Z))).
      { apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_r; lra. }
      assert (off_by d e * (1001 / 1000 * Z) <= 100 * (u * S) * (1001 / 1000 * Z)) by (apply Rmult_le_compat_r; lra).
      assert (0 < u * (S * Z)) by (apply Rmult_lt_0_compat; [lra | apply Rmult_lt_0_compat; lra]).
      replace (5 * u * (1001 / 1000 * S * (1001 / 1000 * Z)))
        with (5 * (1001 / 1000 * (1001 / 1000)) * (u * (S * Z))) in * by ring.
      replace (100 * (u * S) * (1001 / 1000 * Z)) with (1001 / 10 * (u * (S * Z))) in * by field. lra.
  - rewrite M. eapply Rle_trans; [apply (dot_L1 _ _ _ v_size)|].
    assert (L1 (vscale s e) * (1001 / 1000 * Z) <= 1002 / 1000 * S * (1001 / 1000 * Z)) by (apply Rmult_le_compat_r; lra).
    assert (0 < S * Z) by (apply Rmult_lt_0_compat; lra).
    replace (1002 / 1000 * S * (1001 / 1000 * Z)) with (1002 / 1000 * (1001 / 1000) * (S * Z)) in * by field. lra.
Qed.
End Vertex.
