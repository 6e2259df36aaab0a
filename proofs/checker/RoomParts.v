(** `forms` of verify.py, as expressions; and what their parts are: points, sides and cross products, of few
    roundings. [Room.v] is about the whole. *)
Require Import ZArith Reals Psatz String Bool.
From Flocq Require Import Core.
From Reftrace Require Import Geometry Trees Rounding Signs.
Open Scope R_scope.
Open Scope string_scope.

(** ** As the code has it *)

Definition vector_named (name : string) : tvec :=
  (Var (name ++ "x"), Var (name ++ "y"), Var (name ++ "z")).
Definition tmost a := Max (Max (Abs (X a)) (Abs (Y a))) (Abs (Z' a)).
Definition ttimes k a : tvec := (Mul k (X a), Mul k (Y a), Mul k (Z' a)).
Record form := Form { point : tvec; times : Z; vector : tvec; size : expr }.
Definition middle := vector_named "middle".
Definition half := vector_named "half".
Definition slope f := ttimes (Num (times f) 0) (vector f).
Definition value_of f := Add (tdot (point f) (vector f)) (tdot (slope f) middle).
Definition away f := Add (tmost (point f)) (Mul (Num (Z.abs (times f)) 0) (Var "largest")).
Definition error_of f := (* 2^-44 is 512 u *)
  Add (Mul (Num 1 (-44)) (Mul (away f) (size f))) (Mul (Num 1 (-1040)) (Add (Num 1 0) (away f))).
Definition reach_of f := Add (error_of f) (tdot (tabs (slope f)) half).

(** ** Roundings *)

Lemma rnd_low x : 0 <= x -> (1 - u) * x - eta <= rnd x.
Proof. intros H. generalize (rnd_err x). rewrite (Rabs_pos_eq x H). intros E. apply Rabs_le_inv in E. lra.
Qed.
Lemma rnd_low_sum x y : is_float x -> is_float y -> 0 <= x + y -> (1 - u) * (x + y) <= rnd (x + y).
Proof.
  intros X Y H. generalize (rnd_err_sum x y X Y). rewrite (Rabs_pos_eq _ H). intros E.
  apply Rabs_le_inv in E. lra.
Qed.
Lemma small_share x : 0 <= x -> 0 <= u * x <= / 9000000000000000 * x.
Proof.
  intros X. generalize u_pos u_small. intros. split; [apply Rmult_le_pos; lra | apply Rmult_le_compat_r; lra].
Qed.
Definition most (x y z : R) : R := Rmax (Rmax (Rabs x) (Rabs y)) (Rabs z).
Lemma most_is x y z : Rabs x <= most x y z /\ Rabs y <= most x y z /\ Rabs z <= most x y z.
Proof.
  unfold most. repeat split; eauto using Rle_trans, Rmax_l, Rmax_r.
Qed.
Lemma most_low c x y z x' y' z' : 0 <= c ->
  c * Rabs x <= Rabs x' -> c * Rabs y <= Rabs y' -> c * Rabs z <= Rabs z' ->
  c * most x y z <= most x' y' z'.
Proof.
  intros C HX HY HZ. destruct (most_is x' y' z') as (A & B & D).
  unfold most at 1. unfold Rmax at 1 2. repeat destruct Rle_dec; lra.
Qed.

(** A component that is stored, or a difference of two, or the negative of one. *)
Section Parts.
Variable v : renv.
Hypothesis floats : forall name, is_float (r_var v name).
Definition atom (e : expr) : Prop :=
  ring_expr e /\ (depth e <= 1)%nat /\ mag v e = Rabs (ex v e) /\ room v e = Rabs (ex v e).
Definition atoms (a : tvec) : Prop := atom (X a) /\ atom (Y a) /\ atom (Z' a).
Definition exact_most (a : tvec) : R := most (ex v (X a)) (ex v (Y a)) (ex v (Z' a)).
Lemma atom_near e : atom e -> Rabs (fl v e - ex v e) <= u * Rabs (ex v e).
Proof.
  intros (R & D & M & O). generalize (error v floats e R). rewrite M, O.
  assert (A (depth e) <= 1 + u) by (eapply Rle_trans; [apply A_mono, D | unfold A; lra]).
  generalize (Rabs_pos (ex v e)). intros. nra.
Qed.
Lemma atom_low e : atom e -> (1 - u) * Rabs (ex v e) <= Rabs (fl v e).
Proof.
  intros H. apply atom_near in H. revert H. unfold Rabs. repeat destruct Rcase_abs; lra.
Qed.
Lemma most_atoms a : atoms a -> (1 - u) * exact_most a <= fl v (tmost a).
Proof.
  intros (HX & HY & HZ). cbn [tmost value]. apply most_low; auto using atom_low.
  generalize u_small. lra.
Qed.
Lemma most_pos a : 0 <= exact_most a.
Proof. unfold exact_most.
generalize (most_is (ex v (X a)) (ex v (Y a)) (ex v (Z' a))) (Rabs_pos (ex v (X a))). lra. Qed.

(** A component of a cross product of such, or one itself: some 4 roundings of what is at most 2 M. *)
Definition component (M : R) (e : expr) : Prop :=
  ring_expr e /\ (depth e <= 4)%nat /\ mag v e <= 2 * M /\ room v e <= mag v e + 2 * eta.
Definition components (M : R) (a : tvec) : Prop :=
  component M (X a) /\ component M (Y a) /\ component M (Z' a).
Lemma cross_components a b : atoms a -> atoms b ->
  components (exact_most a * exact_most b) (tcross a b).
Proof.
  intros ((Rx & Dx & Mx & Ox) & (Ry & Dy & My & Oy) & (Rz & Dz & Mz & Oz)).
  intros ((Rx' & Dx' & Mx' & Ox') & (Ry' & Dy' & My' & Oy') & (Rz' & Dz' & Mz' & Oz')).
  destruct (most_is (ex v (X a)) (ex v (Y a)) (ex v (Z' a))) as (A1 & A2 & A3).
  destruct (most_is (ex v (X b)) (ex v (Y b)) (ex v (Z' b))) as (B1 & B2 & B3).
  assert (PA := most_pos a). assert (PB := most_pos b).
  fold (exact_most a) in A1, A2, A3. fold (exact_most b) in B1, B2, B3.
  assert (P : forall x y, Rabs x <= exact_most a -> Rabs y <= exact_most b ->
    Rabs x * Rabs y <= exact_most a * exact_most b).
  { intros. apply Rmult_le_compat; auto using Rabs_pos. }
  destruct a as [[ax ay] az], b as [[bx by_] bz]. unfold X, Y, Z', tcross in *. cbn [fst snd] in *.
  unfold components, component, X, Y, Z'. cbn [fst snd ring_expr depth mag room leaf andb].
  rewrite Mx, My, Mz, Mx', My', Mz', Ox, Oy, Oz, Ox', Oy', Oz'.
  repeat split; auto; try lia;
    match goal with |- _ * _ + _ * _ <= _ => idtac | |- _ => lra end;
    match goal with |- Rabs ?x * Rabs ?y + Rabs ?z * Rabs ?w <= _ =>
      assert (Rabs x * Rabs y <= exact_most (ax, ay, az) * exact_most (bx, by_, bz)) by (apply P; assumption);
      assert (Rabs z * Rabs w <= exact_most (ax, ay, az) * exact_most (bx, by_, bz)) by (apply P; assumption);
      lra end.
Qed.
Lemma atoms_components a : atoms a -> components (exact_most a) a.
Proof.
  intros ((Rx & Dx & Mx & Ox) & (Ry & Dy & My & Oy) & (Rz & Dz & Mz & Oz)).
  destruct (most_is (ex v (X a)) (ex v (Y a)) (ex v (Z' a))) as (A1 & A2 & A3).
  fold (exact_most a) in A1, A2, A3. assert (N := eta_pos). assert (P := most_pos a).
  repeat split; auto; try lia; lra.
Qed.
End Parts.
