(** What verify.py computes and decides in integers is what Leaf.v says: its functions, recorded whole,
    all branches included ([RecordedChecker]). Leaf.v was written by hand from the Python; here a
    machine has compared the two. *)
Require Import ZArith Reals List Bool Lia.
From Reftrace Require Import Integers Ties Leaf RecordedChecker.
From Reftrace Require Contest.
Import ListNotations.
Open Scope Z_scope.

Lemma vector_is v : I3 (ix v) (iy v) (iz v) = v.
Proof. now destruct v. Qed.

(** [Exact.surface_from] *)
Theorem triangle_is o a b c :
  check_triangle (ix o) (iy o) (iz o) (ix a) (iy a) (iz a) (ix b) (iy b) (iz b) (ix c) (iy c) (iz c) =
  of_triangle o a b c.
Proof. reflexivity. Qed.
Theorem plane_is o p n :
  check_plane (ix o) (iy o) (iz o) (ix p) (iy p) (iz p) (ix n) (iy n) (iz n) = of_plane o p n.
Proof. unfold check_plane, of_plane. now rewrite vector_is. Qed.

(** [Exact.hit], of what that returns *)
Section Hit.
Variables (name : Contest.name) (d n m1 s1 m2 s2 m3 s3 : Integers) (T : Z) (start last : Z * Z).
Notation of_hit f := (f name (ix d) (iy d) (iz d) T (ix n) (iy n) (iz n) (fst start) (snd start)
  (fst last) (snd last)).
Ltac hit :=
  unfold hit, mixed, ends; cbn [map app min_ max_ fold_right]; rewrite !vector_is;
  unfold _dot; match goal with |- (if ?c then _ else _) = _ => destruct c end; [reflexivity|];
  match goal with |- (if ?p <? 0 then if 0 <? ?q then _ else _ else _) =
      (if (?p' <? 0) && (0 <? ?q') then _ else _) =>
    replace p' with p by lia; replace q' with q by lia; destruct (p <? 0), (0 <? q) end;
  cbn [andb]; try reflexivity; destruct (T =? fst start), (fst start =? 0); reflexivity.
Theorem hit_is :
  of_hit check_hit (ix m1) (iy m1) (iz m1) (ix s1) (iy s1) (iz s1) (ix m2) (iy m2) (iz m2)
    (ix s2) (iy s2) (iz s2) (ix m3) (iy m3) (iz m3) (ix s3) (iy s3) (iz s3) =
  hit start last name d (T, n, [(m1, s1); (m2, s2); (m3, s3)]).
Proof. unfold check_hit. hit. Qed.
Theorem plane_hit_is : of_hit check_plane_hit = hit start last name d (T, n, []).
Proof. unfold check_plane_hit. hit. Qed.
End Hit.

(** [moved], by the rule *)
Theorem moved_is e m edge d :
  check_moved e (ix m) (iy m) (iz m) (ix edge) (iy edge) (iz edge) (ix d) (iy d) (iz d) =
  moved e m edge d AXES.
Proof.
  unfold check_moved, moved, is_zero, rows, zfirst, AXES, PERTURBATION, _dot, _cross.
  cbn [map concat app ix iy iz].
  destruct (ix m =? 0), (iy m =? 0), (iz m =? 0); cbn [andb app fold_right]; reflexivity.
Qed.

(** [Hit.is_crossed], of a triangle; [Hit.is_before] *)
Theorem is_crossed_is name T D n d e1 e2 e3 m1 s1 m2 s2 m3 s3 moves :
  check_is_crossed D (ix d) (iy d) (iz d) e1 e2 e3 (ix m1) (iy m1) (iz m1) (ix s1) (iy s1) (iz s1)
    (ix m2) (iy m2) (iz m2) (ix s2) (iy s2) (iz s2) (ix m3) (iy m3) (iz m3) (ix s3) (iy s3) (iz s3) moves =
  is_crossed moves (MakeMet name T D n [(e1, m1, s1); (e2, m2, s2); (e3, m3, s3)] d).
Proof.
  unfold check_is_crossed, is_crossed. cbn [bottom rims along forallb]. rewrite !vector_is.
  destruct (0 <? _); [|reflexivity]. destruct (0 <? _); [|reflexivity]. now destruct (0 <? _).
Qed.
Theorem is_before_is i1 j1 T1 D1 n1 r1 i2 j2 T2 D2 n2 r2 d d' moves :
  check_is_before i1 j1 T1 D1 (ix n1) (iy n1) (iz n1) i2 j2 T2 D2 (ix n2) (iy n2) (iz n2)
    (ix d) (iy d) (iz d) moves =
  is_before moves (MakeMet (i1, j1) T1 D1 n1 r1 d) (MakeMet (i2, j2) T2 D2 n2 r2 d').
Proof.
  unfold check_is_before, is_before, order, line, Contest.name_before. rewrite !vector_is.
  cbn [named top bottom normal along fst snd]. unfold _cross, ZERO.
  destruct (T1 =? 0); (destruct (_ <? 0); [reflexivity|]); (destruct (_ =? 0); [|reflexivity]);
    cbn [orb andb]; destruct (Z.ltb_spec i1 i2), (Z.eqb_spec i1 i2), (Z.eqb_spec j1 j2), (Z.ltb_spec j1 j2);
    try reflexivity; lia.
Qed.

(** [first] and [sees], of up to three hits *)
Section Seen.
Variables h0 h1 h2 : Met.
Ltac ask x := destruct x eqn:?; cbn [fold_left filter negb is_lt is_eq is_gt]; try congruence.
Section First.
Variable moves : list Integers.
Ltac follow :=
  unfold first, nearer_of; cbn [fold_left];
  repeat match goal with
  | |- context [is_crossed moves ?h] => ask (is_crossed moves h)
  | |- context [is_before moves ?h ?g] => is_var h; is_var g; ask (is_before moves h g)
  end.
Theorem first_of_1_is : check_first_of_1 moves h0 = first moves [h0].
Proof. unfold check_first_of_1. follow. Qed.
Theorem first_of_2_is : check_first_of_2 moves h0 h1 = first moves [h0; h1].
Proof. unfold check_first_of_2. follow. Qed.
Theorem first_of_3_is : check_first_of_3 moves h0 h1 h2 = first moves [h0; h1; h2].
Proof. unfold check_first_of_3. follow. Qed.
End First.
Lemma same_ratio T D : compare_ratios T D T D = Eq.
Proof. apply Z.compare_refl. Qed.
Ltac follow :=
  unfold sees, front, inside; cbn [filter];
  repeat match goal with |- context [on_edge ?h] => ask (on_edge h) end;
  cbn [forallb]; unfold not_behind, compare_at; rewrite ?same_ratio; cbn [is_gt andb];
  repeat (match goal with
    | |- context [compare_ratios (top ?h) (bottom ?h) (top ?g) (bottom ?g)] =>
        ask (compare_ratios (top h) (bottom h) (top g) (bottom g))
    end; cbn [andb filter]); try reflexivity.
Theorem sees_1_is : check_sees_1 h0 = sees [h0].
Proof. unfold check_sees_1. follow. Qed.
Theorem sees_2_is : check_sees_2 h0 h1 = sees [h0; h1].
Proof. unfold check_sees_2. follow. Qed.
Theorem sees_3_is : check_sees_3 h0 h1 h2 = sees [h0; h1; h2].
Proof. unfold check_sees_3. follow. Qed.
End Seen.
