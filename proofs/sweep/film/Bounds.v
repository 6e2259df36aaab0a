(** The bounds of [film.py] as floats: what their own roundings may take off them.

    Every definition is the code's formula with a [rnd] for each operation. *)
Require Import ZArith Reals Psatz.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Camera Place Film.
Open Scope R_scope.

Lemma lo x y : 0 <= y -> y <= x -> 9999 / 10000 * y - eta <= rnd x.
Proof.
  intros H K. apply rnd_le in K. eapply Rle_trans; [|exact K].
  generalize (Rabs_le_inv _ _ (rnd_err y)). rewrite (Rabs_pos_eq y H).
  assert (u * y <= / 10000 * y) by (apply Rmult_le_compat_r; [exact H | generalize u_tiny; lra]). lra.
Qed.
Lemma lo1 x : 0 <= x -> 9999 / 10000 * x - eta <= rnd x.
Proof. intros H. exact (lo x x H (Rle_refl x)). Qed.
Lemma hi x y : 0 <= y -> x <= y -> rnd x <= 10001 / 10000 * y + eta.
Proof.
  intros H K. apply rnd_le in K. eapply Rle_trans; [exact K|].
  generalize (Rabs_le_inv _ _ (rnd_err y)). rewrite (Rabs_pos_eq y H).
  assert (u * y <= / 10000 * y) by (apply Rmult_le_compat_r; [exact H | generalize u_tiny; lra]). lra.
Qed.
Definition eps := bpow radix2 (-52). (* [_EPS]: 2 u *)
Lemma eps_u : eps = 2 * u. Proof. unfold eps, u. field. Qed.
Definition tiny := bpow radix2 (-960).

(** ** [size] of a vertex; V and O are the largest |.| of the components of v and o *)
Definition vertex_size (V O : R) := rnd (V + rnd (O + tiny)).

Theorem size_holds v o V O : within v V -> within o O ->
  within (vsub v o) (1001 / 1000 * vertex_size V O) /\ bpow radix2 (-970) <= vertex_size V O.
Proof.
  intros [V0 [V1 V2]] [O0 [O1 O2]]. unfold vertex_size.
  assert (T : eta <= tiny / 1000000).
  { unfold eta, tiny. replace (-1074)%Z with (-114 + -960)%Z by reflexivity. rewrite bpow_plus.
    assert (bpow radix2 (-114) <= / 1000000).
    { apply Rle_trans with (bpow radix2 (-20)); [apply bpow_le; lia | simpl; lra]. }
    generalize (bpow_gt_0 radix2 (-960)). nra. }
  assert (P : 0 < tiny) by apply bpow_gt_0. assert (VP := Rle_trans _ _ _ (Rabs_pos _) V0).
  assert (OP := Rle_trans _ _ _ (Rabs_pos _) O0).
  assert (A := lo1 (O + tiny) ltac:(lra)).
  assert (B := lo (V + rnd (O + tiny)) (V + (9999 / 10000 * (O + tiny) - eta)) ltac:(lra) ltac:(lra)).
  set (Z := rnd (V + rnd (O + tiny))) in *.
  assert (G : V + O <= 1001 / 1000 * Z) by lra.
  assert (Q : bpow radix2 (-970) <= tiny / 2).
  { unfold tiny. replace (-970)%Z with (-10 + -960)%Z by reflexivity. rewrite bpow_plus.
    assert (bpow radix2 (-10) <= / 2) by (apply (bpow_le radix2 (-10) (-1)); lia).
    generalize (bpow_gt_0 radix2 (-960)). fold tiny. nra. }
  split; [|lra]. repeat split; unfold vsub; simpl; (eapply Rle_trans; [apply tri; eassumption | exact G]).
Qed.

(** ** The window along one axis: from [left] to [right], n pixels *)
Definition pixel_size (left right n : R) := rnd (rnd (right - left) / n).
Definition window (left right n : R) := Axis left (pixel_size left right n) n (Rmax (Rabs left) (Rabs right)).

Theorem window_holds left right n i dx : left < right -> 1 <= n -> n <= bpow radix2 40 ->
  bpow radix2 (-1020) <= pixel_size left right n ->
  0 <= i -> i + 1 <= n -> Rabs dx <= / 2 -> in_picture (window left right n) i dx.
Proof.
  intros LR N N' W I0 I1 D. unfold in_picture; simpl. repeat split; try assumption.
  set (p := pixel_size left right n) in *. set (r := Rmax (Rabs left) (Rabs right)).
  assert (Rl : Rabs left <= r) by apply Rmax_l. assert (Rr : Rabs right <= r) by apply Rmax_r.
  assert (P := u_pos). assert (T := u_tiny). assert (E := eta_pos). assert (Ep := eta_pixel p W).
  assert (Pp : 0 < p) by (eapply Rlt_le_trans; [apply bpow_gt_0 | exact W]).
  assert (F := window_near left p n i dx W I0 I1 D). unfold near in F.
  apply Rabs_le_inv in D. assert (Rl' := Rabs_le_inv _ _ Rl). assert (Rr' := Rabs_le_inv _ _ Rr).
  (* n pixels are the window's width, but for roundings *)
  assert (up : u * p <= / 1000000000000000 * p) by (apply Rmult_le_compat_r; lra).
  assert (np : n * p <= 1001 / 1000 * (right - left) + n * p / 1000).
  { assert (A := hi (right - left) (right - left) ltac:(lra) (Rle_refl _)). set (wd := rnd (right - left)) in *.
    assert (A0 : 0 <= wd) by (apply rnd_pos; lra).
    assert (In : 0 < / n) by (apply Rinv_0_lt_compat; lra).
    assert (Q : 0 <= wd / n) by (apply Rmult_le_pos; lra).
    assert (B := hi (wd / n) (wd / n) Q (Rle_refl _)). change (rnd (wd / n)) with p in B.
    assert (C : n * p <= n * (10001 / 10000 * (wd / n) + u * p / 4)) by (apply Rmult_le_compat_l; lra).
    replace (n * (10001 / 10000 * (wd / n) + u * p / 4)) with (10001 / 10000 * wd + u * (n * p) / 4) in C by (field; lra).
    assert (n * p >= 1 * p) by (apply Rle_ge, Rmult_le_compat_r; lra).
    assert (u * (n * p) <= / 1000000000000000 * (n * p)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (G : Rabs (left + (i + / 2 + dx) * p) <= 1008 / 1000 * r).
  { assert (0 <= (i + / 2 + dx) * p) by (apply Rmult_le_pos; lra).
    assert ((i + / 2 + dx) * p <= n * p) by (apply Rmult_le_compat_r; lra).
    apply Rabs_le. lra. }
  assert (un : u * (Rabs left + 5 * n * p) <= / 1000000 * (Rabs left + 5 * n * p)).
  { apply Rmult_le_compat_r; [|lra]. generalize (Rabs_pos left). assert (0 <= n * p) by (apply Rmult_le_pos; lra). lra. }
  generalize (near_abs _ _ _ _ F G). lra.
Qed.

(** ** [ray_error] *)
Definition length (m reach : R) := rnd (m * rnd (1 + reach)).
Definition length' (m most reach : R) := rnd (most + rnd (m * reach)). (* orthographic *)
Definition ray_error (S length : R) := rnd (rnd (24 * eps * S) * length).

Lemma error_of_length S L r : 1 <= S -> 0 <= L -> 0 <= r -> 0 <= 9995 / 10000 * r - 10 * eta <= L ->
  479 / 10 * (u * (S * r)) - 500 * (u * (S * eta)) - 2 * eta <= ray_error S L.
Proof.
  intros HS HL Hr [H0 H]. unfold ray_error. rewrite eps_u. assert (P := u_pos). assert (E := eta_u6). assert (Pe := eta_pos).
  assert (uS : u * 1 <= u * S) by (apply Rmult_le_compat_l; lra).
  assert (A := lo (24 * (2 * u) * S) (48 * (u * S)) ltac:(lra) ltac:(lra)).
  assert (A' : 4799 / 100 * (u * S) <= rnd (24 * (2 * u) * S)) by lra.
  assert (B : 4799 / 100 * (u * S) * (9995 / 10000 * r - 10 * eta) <= rnd (24 * (2 * u) * S) * L).
  { apply Rmult_le_compat; lra. }
  assert (B0 : 0 <= 4799 / 100 * (u * S) * (9995 / 10000 * r - 10 * eta)) by (apply Rmult_le_pos; lra).
  assert (C := lo _ _ B0 B).
  assert (0 <= u * (S * r)) by (repeat (lra || apply Rmult_le_pos)).
  assert (0 <= u * (S * eta)) by (repeat (lra || apply Rmult_le_pos)).
  replace (4799 / 100 * (u * S) * (9995 / 10000 * r - 10 * eta))
    with (4799 / 100 * (9995 / 10000) * (u * (S * r)) - 4799 / 10 * (u * (S * eta))) in C by field. lra.
Qed.

(** ** [weight], and the second number of [depth_error] *)
Definition weight (S : R) := rnd (64 * eps * S).
Lemma weight_holds S : 1 <= S -> 9999 / 10000 * (128 * u * S) - eta <= weight S.
Proof.
  intros H. unfold weight. rewrite eps_u. assert (P := u_pos).
  assert (0 <= u * S) by (repeat (lra || apply Rmult_le_pos)). apply lo; lra.
Qed.

(** ** [place] *)
Definition film_error (start size width height : R) :=
  rnd (64 * eps * rnd (rnd (Rabs (rnd (start / size)) + width) + height)).
Definition own_error (start size : R) := rnd (rnd (72 * eps * rnd (1 + Rabs start)) / size).
Definition ray_part_error (re reach size : R) := rnd (rnd (2 * re * rnd (1 + reach)) / size).
Definition slope (S own film ray : R) := rnd (S * rnd (rnd (own + film) + ray)).
Definition slope' (S size : R) := rnd (rnd (72 * eps * S) / size). (* orthographic *)
Definition constant' (film re size : R) := rnd (film + rnd (2 * re / size)).

Section Place.
Variable a : axis.
Hypothesis ok : axis_ok a.
(** The picture's width and height, in this order on both axes. *)
Variables wide high : R.
Hypothesis wide_some : 1 <= wide.
Hypothesis high_some : 1 <= high.
Notation k := (/ pixel a).
Notation l := (Rabs (start a)).
Variables S re : R.
Hypothesis S_some : 1 <= S.
Hypothesis re_pos : 0 <= re.

Lemma pixel_pos : 0 < pixel a. Proof. eapply Rlt_le_trans; [apply bpow_gt_0 | exact (proj1 (proj1 ok))]. Qed.
Lemma k_pos : 0 < k. Proof. apply Rinv_0_lt_compat, pixel_pos. Qed.
Lemma eta_k : eta <= u * k / 1000000.
Proof.
  assert (K : bpow radix2 (-1000) <= k).
  { replace (-1000)%Z with (- (1000))%Z by reflexivity. rewrite bpow_opp. apply Rinv_le; [apply pixel_pos | exact (proj2 (proj1 ok))]. }
  apply Rle_trans with (u * bpow radix2 (-1000) / 1000000).
  - unfold eta, u. replace (-1074)%Z with (-22 + (-52 + -1000))%Z by reflexivity. rewrite !bpow_plus.
    assert (bpow radix2 (-22) <= / 1000000) by (simpl; lra).
    assert (0 < bpow radix2 (-52) * bpow radix2 (-1000)) by (apply Rmult_lt_0_compat; apply bpow_gt_0). nra.
  - apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; [apply Rlt_le, u_pos | exact K].
Qed.

Lemma film_holds : 999 / 1000 * (128 * u * (l * k + wide + high)) <= film_error (start a) (pixel a) wide high.
Proof.
  unfold film_error. rewrite eps_u. assert (P := u_pos). assert (E := eta_u6). assert (K := k_pos). destruct ok as [_ [N _]].
  assert (T := u_tiny). assert (Pe := eta_pos). assert (Lk : 0 <= l * k) by (apply Rmult_le_pos; [apply Rabs_pos | lra]).
  assert (A : 9999 / 10000 * (l * k) - eta <= Rabs (rnd (start a / pixel a))).
  { rewrite <- rnd_abs. unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq k) by lra. apply lo; lra. }
  assert (B := lo (Rabs (rnd (start a / pixel a)) + wide) (9999 / 10000 * (l * k) - eta + wide) ltac:(lra) ltac:(lra)).
  set (b := rnd (Rabs (rnd (start a / pixel a)) + wide)) in *.
  assert (C := lo (b + high) (9998 / 10000 * (l * k + wide) - 2 * eta + high) ltac:(lra) ltac:(lra)).
  set (c := rnd (b + high)) in *.
  assert (C' : 9995 / 10000 * (l * k + wide + high) <= c) by lra.
  assert (D : u * (9995 / 10000 * (l * k + wide + high)) <= u * c) by (apply Rmult_le_compat_l; lra).
  assert (0 <= u * (l * k + wide + high)) by (apply Rmult_le_pos; lra).
  assert (F := lo (64 * (2 * u) * c) (128 * (9995 / 10000) * (u * (l * k + wide + high))) ltac:(lra) ltac:(lra)).
  assert (u * 1 <= u * (l * k + wide + high)) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Theorem slope_holds : 98 / 100 * (S * (144 * u * (1 + l) / pixel a + 128 * u * (l / pixel a + wide + high) +
    2 * re * (1 + reach a) / pixel a)) <=
  slope S (own_error (start a) (pixel a)) (film_error (start a) (pixel a) wide high) (ray_part_error re (reach a) (pixel a)).
Proof.
  unfold Rdiv. assert (P := u_pos). assert (E := eta_u6). assert (K := k_pos). assert (F := film_holds). assert (Ek := eta_k). assert (Tu := u_tiny).
  destruct ok as [_ [N R0]]. assert (Pe := eta_pos). assert (L0 := Rabs_pos (start a)).
  assert (Lk : 0 <= l * k) by (apply Rmult_le_pos; lra).
  assert (OWN : 999 / 1000 * (144 * (u * ((1 + l) * k))) <= own_error (start a) (pixel a)).
  { unfold own_error. rewrite eps_u.
    assert (A := lo1 (1 + l) ltac:(lra)). assert (A' : 9998 / 10000 * (1 + l) <= rnd (1 + l)) by lra.
    assert (B0 : u * (9998 / 10000 * (1 + l)) <= u * rnd (1 + l)) by (apply Rmult_le_compat_l; lra).
    assert (u1 : u * 1 <= u * (1 + l)) by (apply Rmult_le_compat_l; lra).
    assert (B := lo (72 * (2 * u) * rnd (1 + l)) (144 * (9998 / 10000) * (u * (1 + l))) ltac:(lra) ltac:(lra)).
    set (b := rnd (72 * (2 * u) * rnd (1 + l))) in *.
    assert (C : 144 * (9995 / 10000) * (u * (1 + l)) * k <= b * k) by (apply Rmult_le_compat_r; lra).
    assert (u2 : u * 1 * k <= u * (1 + l) * k) by (apply Rmult_le_compat_r; lra).
    assert (D := lo (b / pixel a) (144 * (9995 / 10000) * (u * (1 + l)) * k) ltac:(lra) C). lra. }
  assert (RAY : 999 / 1000 * (2 * (re * ((1 + reach a) * k))) - 3 * (eta * k) - eta <= ray_part_error re (reach a) (pixel a)).
  { unfold ray_part_error.
    assert (A := lo1 (1 + reach a) ltac:(lra)). assert (A' : 9998 / 10000 * (1 + reach a) <= rnd (1 + reach a)) by lra.
    assert (B0 : re * (9998 / 10000 * (1 + reach a)) <= re * rnd (1 + reach a)) by (apply Rmult_le_compat_l; lra).
    assert (0 <= re * (1 + reach a)) by (apply Rmult_le_pos; lra).
    assert (B := lo (2 * re * rnd (1 + reach a)) (2 * (9998 / 10000) * (re * (1 + reach a))) ltac:(lra) ltac:(lra)).
    assert (B1 : 0 <= rnd (2 * re * rnd (1 + reach a))) by (apply rnd_pos; lra).
    set (b := rnd (2 * re * rnd (1 + reach a))) in *.
    assert (C : (2 * (9995 / 10000) * (re * (1 + reach a)) - eta) * k <= b * k) by (apply Rmult_le_compat_r; lra).
    assert (B2 : 0 <= b * k) by (apply Rmult_le_pos; lra).
    assert (D := lo1 (b / pixel a) B2).
    assert (0 <= re * (1 + reach a) * k) by (apply Rmult_le_pos; lra).
    assert (0 <= eta * k) by (apply Rmult_le_pos; lra). lra. }
  set (own := own_error _ _) in *. set (film := film_error _ _ _ _) in *. set (ray := ray_part_error _ _ _) in *.
  assert (ek : eta * k <= u * k / 1000000) by (apply Rle_trans with (u / 1000000 * k); [apply Rmult_le_compat_r; lra | lra]).
  assert (o0 : 0 <= u * (l * k)) by (apply Rmult_le_pos; lra).
  assert (o1 : 0 < u * k) by (apply Rmult_lt_0_compat; lra).
  assert (n0 : u * 1 <= u * wide) by (apply Rmult_le_compat_l; lra).
  assert (n1 : u * 1 <= u * high) by (apply Rmult_le_compat_l; lra).
  assert (r0 : 0 <= re * ((1 + reach a) * k)) by (repeat (lra || apply Rmult_le_pos)).
  assert (ek0 : 0 <= eta * k) by (apply Rmult_le_pos; lra).
  assert (A := lo1 (own + film) ltac:(lra)).
  assert (W0 : 0 <= rnd (own + film) + ray) by lra.
  assert (B := lo1 (rnd (own + film) + ray) W0).
  unfold slope. set (s2 := rnd (rnd (own + film) + ray)) in *.
  set (T := 144 * u * (1 + l) * k + 128 * u * (l * k + wide + high) + 2 * re * (1 + reach a) * k).
  assert (T0 : u <= T) by (unfold T; lra).
  assert (C : 99 / 100 * T <= s2) by (unfold T; lra).
  assert (C' : S * (99 / 100 * T) <= S * s2) by (apply Rmult_le_compat_l; lra).
  assert (ST : 1 * T <= S * T) by (apply Rmult_le_compat_r; lra).
  assert (D := lo (S * s2) (99 / 100 * (S * T)) ltac:(lra) ltac:(lra)). lra.
Qed.

Theorem place_holds' : 98 / 100 * (144 * u * S / pixel a) <= slope' S (pixel a) /\
  98 / 100 * (128 * u * (l / pixel a + wide + high) + 2 * re / pixel a) <=
  constant' (film_error (start a) (pixel a) wide high) re (pixel a).
Proof.
  assert (P := u_pos). assert (E := eta_u6). assert (K := k_pos). assert (F := film_holds). assert (Ek := eta_k). assert (Tu := u_tiny).
  destruct ok as [_ [N R0]]. assert (Pe := eta_pos). unfold Rdiv at 2 4 5.
  assert (Lk : 0 <= l * k) by (apply Rmult_le_pos; [apply Rabs_pos | lra]). split.
  - unfold slope'. rewrite eps_u. assert (uS : u * 1 <= u * S) by (apply Rmult_le_compat_l; lra).
    assert (A := lo (72 * (2 * u) * S) (144 * (u * S)) ltac:(lra) ltac:(lra)).
    set (b := rnd (72 * (2 * u) * S)) in *.
    assert (C : 144 * (9998 / 10000) * (u * S) * k <= b * k) by (apply Rmult_le_compat_r; lra).
    assert (u2 : u * 1 * k <= u * S * k) by (apply Rmult_le_compat_r; lra).
    assert (D := lo (b / pixel a) (144 * (9998 / 10000) * (u * S) * k) ltac:(lra) C). lra.
  - unfold constant'. assert (r0 : 0 <= re * k) by (apply Rmult_le_pos; lra).
    assert (A := lo (2 * re / pixel a) (2 * (re * k)) ltac:(lra) ltac:(unfold Rdiv; lra)).
    set (film := film_error _ _ _ _) in *. set (ray := rnd (2 * re / pixel a)) in *.
    assert (o0 : 0 <= u * (l * k)) by (apply Rmult_le_pos; lra).
    assert (n0 : u * 1 <= u * wide) by (apply Rmult_le_compat_l; lra).
    assert (n1 : u * 1 <= u * high) by (apply Rmult_le_compat_l; lra).
    assert (B := lo (film + ray) (999 / 1000 * (128 * u * (l * k + wide + high)) + (9999 / 10000 * (2 * (re * k)) - eta))
      ltac:(lra) ltac:(lra)). lra.
Qed.
End Place.

(** ** [_spread]: numpy adds nine numbers in this order *)
Definition sum9 (a b c d e f g h i : R) :=
  rnd (rnd (rnd (rnd (a + b) + rnd (c + d)) + rnd (rnd (e + f) + rnd (g + h))) + i).

Lemma sum_step k a b A B : near a A (k / 1000000 * A) -> near b B (k / 1000000 * B) ->
  is_float a -> is_float b -> 0 <= A -> 0 <= B -> 0 <= k <= 10 -> near (rnd (a + b)) (A + B) ((k + 1) / 1000000 * (A + B)).
Proof.
  intros Ha Hb Fa Fb PA PB Hk. assert (T := u_tiny). assert (P := u_pos).
  assert (R := rnd_err_sum a b Fa Fb). assert (N := near_add _ _ _ _ _ _ Ha Hb).
  assert (k / 1000000 * (A + B) <= A + B).
  { rewrite <- (Rmult_1_l (A + B)) at 2. apply Rmult_le_compat_r; lra. }
  assert (C : Rabs (a + b) <= 2 * (A + B)).
  { eapply Rle_trans; [apply (near_abs _ _ _ (A + B) N); rewrite Rabs_pos_eq; lra|]. lra. }
  assert (u * Rabs (a + b) <= / 2000000 * (2 * (A + B))).
  { apply Rle_trans with (u * (2 * (A + B))); [apply Rmult_le_compat_l; lra | apply Rmult_le_compat_r; lra]. }
  eapply near_le; [eapply near_trans; [exact R | exact N]|]. lra.
Qed.
Theorem sum9_near a b c d e f g h i : (forall x, List.In x (a :: b :: c :: d :: e :: f :: g :: h :: i :: nil)%list -> is_float x /\ 0 <= x) ->
  let s := a + b + (c + d) + (e + f + (g + h)) + i in near (sum9 a b c d e f g h i) s (s / 10000).
Proof.
  intros H s. simpl in H.
  destruct (H a), (H b), (H c), (H d), (H e), (H f), (H g), (H h), (H i); try tauto.
  assert (Z : forall x k, 0 <= x -> 0 <= k -> near x x (k / 1000000 * x)).
  { intros x k X K. eapply near_le; [apply near_refl | apply Rmult_le_pos; lra]. }
  unfold sum9, s. eapply near_le.
  - apply (sum_step 3); try apply rnd_float; try lra; auto; [|apply Z; lra].
    replace (3 / 1000000) with ((2 + 1) / 1000000) by lra.
    apply sum_step; try apply rnd_float; try lra; replace (2 / 1000000) with ((1 + 1) / 1000000) by lra;
      apply sum_step; try apply rnd_float; try lra; replace (1 / 1000000) with ((0 + 1) / 1000000) by lra;
      apply sum_step; auto; try lra; apply Z; lra.
  - lra.
Qed.
