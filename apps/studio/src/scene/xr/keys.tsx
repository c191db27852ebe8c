import { Container, Text } from "@react-three/uikit";

/** Capitals of 32 px: 12 mm high on the wrist, at half an arm's length; 23 mm on panels that stand in the room. */
export const WORDS_PX = 32;

export function Row({ children }: { readonly children: React.ReactNode }) {
  return (
    <Container flexDirection="row" gap={12}>
      {children}
    </Container>
  );
}

/** `atOnce`: acts when pressed; others act when let go, so that a finger can slide off. */
export function Key({
  id,
  words,
  onPress,
  color = "#2b343a",
  ink = "#f2f6f8",
  atOnce = false,
}: {
  readonly id: string;
  readonly words: string;
  readonly onPress: () => void;
  readonly color?: string;
  readonly ink?: string;
  readonly atOnce?: boolean;
}) {
  return (
    <Container
      id={id}
      flexGrow={1}
      flexBasis={0}
      height={84}
      borderRadius={14}
      alignItems="center"
      justifyContent="center"
      backgroundColor={color}
      borderWidth={4}
      borderColor={color}
      hover={{ borderColor: "#f2f6f8" }}
      active={{ transformTranslateZ: -6 }}
      {...(atOnce ? { onPointerDown: onPress } : { onClick: onPress })}
    >
      <Text fontSize={WORDS_PX} fontWeight="medium" color={ink}>
        {words}
      </Text>
    </Container>
  );
}
